-- What corrected bending of a lattice is worth in motion: a bar, five times as long as high, is
-- clamped at one end and let go: it falls freely, or until its tip hits a floor with friction.
-- Compares the path of its tip with that of a finer bar:
--   springlod run bench/bending.lua [-- FINEST]

local s = require "springlod"

local finest = math.tointeger(tonumber((...) or 10))
local length, height = 0.8, 0.16 -- [m]
local material = {young = "1 MPa", density = 1000, poisson = 0.3, damping = "0.5 ms"}
local frames = 100 -- a second

local scenes = {
  {name = "free", scene = {duration = 1}},
  {name = "tip on the floor",
   scene = {duration = 1, obstacles = {{plane = {0, 0, 1, -0.06}, friction = 0.4}}}},
}

local function bar(cells, bending)
  return s.lattice(s.grid{
    cell = height / cells, size = {5 * cells, cells, cells},
    materials = {rubber = material}, fill = function() return "rubber" end,
  }, {bending = bending})
end

-- The mean position of the end face, frame by frame, and the processor time [s].
local function path(model, scene)
  local clock = os.clock()
  local run = s.run(model, scene, {
    anchored = function(node) return node.x < 1e-6 end, frame_rate = frames, quiet = true,
  })
  local seconds, places = os.clock() - clock, {}
  for f = 1, run.frame_count do
    local x, sum, volume = run[f].x, {0, 0, 0}, 0
    for i, node in ipairs(model:nodes()) do
      if node.x > length - 1e-6 then
        for d = 1, 3 do sum[d] = sum[d] + node.volume * x[i][d] end
        volume = volume + node.volume
      end
    end
    places[f] = {sum[1] / volume, sum[2] / volume, sum[3] / volume}
  end
  return places, seconds
end

local function largest_distance(a, b)
  local largest = 0
  for f = 1, math.min(#a, #b) do
    local square = 0
    for d = 1, 3 do square = square + (a[f][d] - b[f][d]) ^ 2 end
    largest = math.max(largest, math.sqrt(square))
  end
  return largest
end

local rows = {}
for _, entry in ipairs(scenes) do
  local reference = path(bar(finest, "corrected"), entry.scene)
  for _, cells in ipairs{2, 3, 4, 6, finest} do
    for _, bending in ipairs{"plain", "corrected"} do
      local places, seconds = path(bar(cells, bending), entry.scene)
      rows[#rows + 1] = {entry.name, cells, bending,
        ("%.2f %%"):format(100 * largest_distance(places, reference) / length),
        ("%.2f s"):format(seconds)}
    end
  end
end
print(s.format_table(rows, {columns = {"scene", "cells across", "bending", "error of the tip",
                                       "processor time"}}))
