-- Writes the levels of a body for other programs, and how far each hangs under gravity here:
--   springlod --unsafe run tests/peers/hang_jobs.lua -- FOLDER [BODY]
-- BODY is one of those below (default: dm_soft, which is 2.3 m long). FOLDER/jobs.json holds a job
-- a level: the held nodes, those whose mean displacement along gravity counts, and that
-- displacement at rest; json/level_N.json the arrays of the level.
local s = require "springlod"

local folder, name = arg[1], arg[2] or "dm_soft"
local earth = 9.81

-- A dumbbell that hangs by an end.
local function dumbbell(unit, metres, rod, rubber)
  return function()
    local mesh = s.import("samples/dumbbell.obj", {unit = unit, up = "z"})
    local materials = {rod = {young = rod, density = 1000, damping = "0.5 ms"},
                       rubber = {young = rubber, density = 1000, damping = "0.5 ms"}}
    return s.voxelize(mesh, {cell = 1.34 * metres, materials = materials})
  end, {earth, 0, 0}
end

-- A small or stiff body of equal cells, held at its low x.
local function block(cell, size, young, gravity, inside)
  local material = {young = young, density = 1000, damping = "0.5 ms", poisson = 0.25}
  return function()
    return s.grid{cell = cell, size = size, materials = {body = material},
                  fill = inside or function() return "body" end}
  end, gravity
end

local function in_ring(x, y)
  local radius = ((x - 0.015) ^ 2 + (y - 0.015) ^ 2) ^ 0.5
  return 0.01 < radius and radius < 0.015 and "body" or nil
end

local bodies = {
  -- 5 cm across
  cube = {block("5 mm", {10, 10, 10}, "1 MPa", {earth, 0, 0})},
  -- 10 cm long, 1 cm thick
  bar = {block("2.5 mm", {40, 4, 4}, "10 MPa", {earth, 0, 0})},
  bent_bar = {block("2.5 mm", {40, 4, 4}, "10 MPa", {0, 0, -earth})},
  -- 3 cm across, 5 mm wide, 6 mm thick
  ring = {block("1.5 mm", {20, 20, 4}, "1 MPa", {earth, 0, 0}, in_ring)},
}
for unit, metres in pairs{cm = 0.01, dm = 0.1, m = 1} do
  bodies[unit .. "_soft"] = {dumbbell(unit, metres, "10 MPa", "0.2 MPa")}
  bodies[unit .. "_stiff"] = {dumbbell(unit, metres, "100 MPa", "20 MPa")}
end
local make_grid, gravity = table.unpack(bodies[name] or error("no body " .. name))

-- Numbers of the nodes with first <= x < last, counted from 1.
local function nodes_within(model, first, last)
  local list = {}
  for i, node in ipairs(model:nodes()) do
    if first <= node.x and node.x < last then list[#list + 1] = i end
  end
  return list
end

local function from_0(list)
  local shifted = {}
  for i, node in ipairs(list) do shifted[i] = node - 1 end
  return shifted
end

-- Mean displacement of the free end along gravity [m], at large displacements.
local function elongation(model, held, free)
  local pull = s.deflect(model, {large = true, anchored = held, force = function(node)
    return {gravity[1] * node.mass, gravity[2] * node.mass, gravity[3] * node.mass}
  end})
  local sum = 0
  for _, node in ipairs(free) do
    for axis = 1, 3 do sum = sum + pull.displacement[node][axis] * gravity[axis] / earth end
  end
  return sum / #free
end

local chain = s.simplify(s.lattice(make_grid()),
                         {levels = 2, grouping = "compact", calibrate = "modes"})
s.save(folder .. "/" .. name .. ".glb", chain)
local jobs = {}
for level = 0, 2 do
  local model = chain[level]
  local first, last = math.huge, -math.huge
  for _, node in ipairs(model:nodes()) do
    first, last = math.min(first, node.x), math.max(last, node.x)
  end
  local reach = (last - first) / 10
  local held = nodes_within(model, first, first + reach)
  local free = nodes_within(model, last - reach, math.huge)
  for _, to in ipairs{"json", "mujoco", "jolt", "bullet"} do
    local path = ("%s/%s/level_%d"):format(folder, to, level)
    s.export(path, chain, {to = to, level = level, gravity = gravity, name = "level_" .. level})
  end
  jobs[#jobs + 1] = {level = level, gravity = gravity, held = from_0(held), free = from_0(free),
                     elongation = elongation(model, held, free)}
end
local file = assert(io.open(folder .. "/jobs.json", "w"))
file:write(s.json(jobs), "\n")
file:close()
