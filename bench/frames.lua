-- Time of the frames of a video: base and two levels of the sample that ./dev demo shows.
--   springlod --unsafe run bench/frames.lua [-- FRAMES [FOLDER]]
-- Each frame has three panels in about 1280 x 720 pixels. Prints the processor time of all threads;
-- divide it by the cores for the least time by the clock, which `time` measures.

local s = require "springlod"

local frames = math.tointeger(tonumber((...) or 60))
local folder = select(2, ...) or "out/bench/frames"
local mesh = s.import(s.samples .. "/dumbbell.obj", {unit = "dm", up = "z"})
local grid = s.voxelize(mesh, {
  cell = "10 cm", materials = dofile(s.samples .. "/firm_dumbbell_materials.lua"),
})
local chain = s.simplify(s.lattice(grid, {style = "centers"}),
  {levels = 2, grouping = "priority", border = "weak"})
local scene = dofile(s.samples .. "/throw_at_wall.lua")
scene.duration = frames / 30
local runs = s.compare(chain, s.scenario(scene), {starts = 1})

local clock, start = os.clock(), os.time()
local drawn = s.animate(folder, runs, {
  frames = frames, width = 427, height = 720, camera = "follow",
})
local seconds = os.clock() - clock
print(s.format_table({{
  drawn, ("%.1f s"):format(seconds), ("%.0f ms"):format(1000 * seconds / drawn),
  ("%d s"):format(os.time() - start),
}}, {columns = {"frames", "processor time", "of a frame", "by the clock"}}))
