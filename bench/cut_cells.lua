-- What cut cells are worth in motion: an egg off the axes is thrown along a floor with friction,
-- rolls and bounces. Compares the path of its centre of mass with that of a finer base:
--   springlod --unsafe run bench/cut_cells.lua [-- FINEST]
-- (--unsafe, since s.import reads the mesh from a temporary file.)

local s = require "springlod"

local finest = math.tointeger(tonumber((...) or 30)) -- cells along a metre
local half_axes = {0.5, 0.4, 0.35} -- [m]
local tilt = 0.5 -- of the egg, about y and then about x [rad]
local rings = 48
local material = {young = "1 MPa", density = 1000, poisson = 0.3, damping = "1 ms"}
local frames = 50 -- a second
local scene = {
  duration = 1.5,
  throw = {position = {0, 0, 1}, velocity = {1.5, 0.3, 0}, spin = {0, 4, 1}},
  obstacles = {{plane = {0, 0, 1, 0}, friction = 0.5}},
}

local function placed(x, y, z)
  local c, d = math.cos(tilt), math.sin(tilt)
  x, y, z = half_axes[1] * x, half_axes[2] * y, half_axes[3] * z
  x, z = c * x + d * z, c * z - d * x
  y, z = c * y + d * z, c * z - d * y
  return ("v %.7f %.7f %.7f"):format(x, y, z)
end

local function egg_text()
  local sectors = 2 * rings
  local lines = {"o egg", placed(0, 0, -1), placed(0, 0, 1)}
  for ring = 1, rings - 1 do
    for sector = 0, sectors - 1 do
      local theta, phi = math.pi * ring / rings, 2 * math.pi * sector / sectors
      lines[#lines + 1] = placed(math.sin(theta) * math.cos(phi), math.sin(theta) * math.sin(phi),
                                 -math.cos(theta))
    end
  end
  local function at(ring, sector) return 3 + (ring - 1) * sectors + sector % sectors end
  local function face(...) lines[#lines + 1] = ("f %d %d %d"):format(...) end
  for k = 0, sectors - 1 do
    face(1, at(1, k + 1), at(1, k))
    face(2, at(rings - 1, k), at(rings - 1, k + 1))
    for ring = 1, rings - 2 do
      face(at(ring, k), at(ring, k + 1), at(ring + 1, k + 1))
      face(at(ring, k), at(ring + 1, k + 1), at(ring + 1, k))
    end
  end
  return table.concat(lines, "\n") .. "\n"
end

local function egg()
  local name = os.tmpname()
  s.save_text(name .. ".obj", egg_text())
  local mesh = s.import(name .. ".obj", {unit = "m", up = "z"})
  os.remove(name .. ".obj")
  os.remove(name)
  return mesh
end

-- The path of the centre of mass, frame by frame, and the processor time [s].
local function path(model)
  local clock = os.clock()
  local run = s.run(model, scene, {frame_rate = frames, quiet = true})
  local seconds, places, mass, nodes = os.clock() - clock, {}, model.mass, model:nodes()
  for f = 1, run.frame_count do
    local x, sum = run[f].x, {0, 0, 0}
    for i, node in ipairs(nodes) do
      for d = 1, 3 do sum[d] = sum[d] + node.mass / mass * x[i][d] end
    end
    places[f] = sum
  end
  return places, seconds
end

local function mean_distance(a, b)
  local sum = 0
  for f = 1, #a do
    local square = 0
    for d = 1, 3 do square = square + (a[f][d] - b[f][d]) ^ 2 end
    sum = sum + math.sqrt(square)
  end
  return sum / #a
end

local mesh = egg()
local function base(cells, cut)
  return s.lattice(s.voxelize(mesh, {cell = 1 / cells, cut_cells = cut, fallback = material}))
end

local reference, rows = path(base(finest, true)), {}
for _, cells in ipairs{10, 14, 20, finest} do
  for _, cut in ipairs{false, true} do
    local model = base(cells, cut)
    local places, seconds = path(model)
    rows[#rows + 1] = {cells, cut and "cut" or "whole", model.node_count,
      ("%.2f %%"):format(100 * mean_distance(places, reference) / (2 * half_axes[1])),
      ("%.2f s"):format(seconds)}
  end
end
print(s.format_table(rows, {columns = {"cells a metre", "cells", "nodes", "mean error of the path",
                                       "processor time"}}))
