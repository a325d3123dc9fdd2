-- The main job on a small body, for the hashes of its results: main_job.lua FOLDER

local s = require "springlod"

local folder = arg[1]
local grid = s.voxelize(s.import(s.samples .. "/dumbbell.obj", {unit = "dm", up = "z"}), {
  cell = "20 cm",
  materials = dofile(s.samples .. "/dumbbell_materials.lua"),
})
local base = s.lattice(grid)
local scene = dofile(s.samples .. "/throw_at_wall.lua")
scene.duration = "0.5 s" -- until shortly after the first impact

local variants = {
  merged = {levels = 2, grouping = "priority", border = "weak", seed = 1},
  calibrated = {levels = 1, grouping = "compact", keep = {0.4}, calibrate = "modes", seed = 1},
}
for name, options in pairs(variants) do
  local chain = s.simplify(base, options)
  s.save(("%s/%s.glb"):format(folder, name), chain)
  local runs = s.compare(chain, s.scenario(scene), {starts = 2, jitter = 0.02, seed = 1})
  local rows, columns = runs:table()
  s.csv(("%s/%s.csv"):format(folder, name), rows, {columns = columns})
end
