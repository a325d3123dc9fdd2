-- Writes the levels of a dumbbell for other programs, and how far each hangs under gravity here:
--   springlod --unsafe run tests/peers/hang_jobs.lua -- FOLDER [UNIT [soft|stiff]]
-- UNIT is that of the mesh: mm, cm, dm (default: the body is 2.3 m long), m. FOLDER/jobs.json holds
-- a job a level: the held nodes, those whose mean displacement counts, and that displacement at
-- rest; json/level_N.json the arrays of the level.
local s = require "springlod"

local folder, unit, kind = arg[1], arg[2] or "dm", arg[3] or "soft"
local gravity = {9.81, 0, 0} -- along the body
local young = {soft = {rod = "10 MPa", rubber = "0.2 MPa"},
               stiff = {rod = "100 MPa", rubber = "20 MPa"}}
local metres = {mm = 0.001, cm = 0.01, dm = 0.1, m = 1}

local function chain_of_dumbbell()
  local mesh = s.import("samples/dumbbell.obj", {unit = unit, up = "z"})
  local materials = {}
  for name, modulus in pairs(young[kind]) do
    materials[name] = {young = modulus, density = 1000, damping = "0.5 ms"}
  end
  local grid = s.voxelize(mesh, {cell = 1.34 * metres[unit], materials = materials})
  return s.simplify(s.lattice(grid), {levels = 2, grouping = "compact", calibrate = "modes"})
end

-- Numbers of the nodes with first <= x < last, counted from 1.
local function nodes_within(model, first, last)
  local list = {}
  for i = 1, model.node_count do
    local x = model:node(i).x
    if first <= x and x < last then list[#list + 1] = i end
  end
  return list
end

local function from_0(list)
  local shifted = {}
  for i, node in ipairs(list) do shifted[i] = node - 1 end
  return shifted
end

-- Mean displacement of the free end [m], at large displacements.
local function elongation(model, held, free)
  local pull = s.deflect(model, {large = true, anchored = held, force = function(node)
    return {gravity[1] * node.mass, 0, 0}
  end})
  local sum = 0
  for _, node in ipairs(free) do sum = sum + pull.displacement[node][1] end
  return sum / #free
end

local chain = chain_of_dumbbell()
s.save(folder .. "/dumbbell.glb", chain)
local jobs = {}
for level = 0, 2 do
  local model = chain[level]
  local first, last = math.huge, -math.huge
  for i = 1, model.node_count do
    local x = model:node(i).x
    first, last = math.min(first, x), math.max(last, x)
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
