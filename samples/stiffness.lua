-- Balls of three stiffnesses dropped side by side:  springlod run samples/stiffness.lua -- [FOLDER]
local s = require "springlod"
local folder = arg[1] or "out/stiffness"

local mesh = s.import(s.samples .. "/ball.obj", {unit = "dm", up = "z"})
local scene = s.scenario{
  name = "drop of a ball",
  duration = "1 s",
  throw = {position = {0, 0, "1 m"}},
  obstacles = {{name = "floor", plane = {0, 0, 1, 0}}},
}

-- Young's moduli of the shell; that of the core is ten times greater.
local labels, runs = {"25 kPa", "100 kPa", "400 kPa"}, {}
for i, young in ipairs(labels) do
  local materials = dofile(s.samples .. "/ball_materials.lua")
  materials.shell.young = young
  materials.core.young = 10 * s.quantity(young, "pressure")
  local grid = s.voxelize(mesh, {cell = "10 cm", materials = materials, priority = {"core"}})
  runs[i] = s.run(s.lattice(grid), scene, {quiet = true})
end

-- One chart and one film of all runs.
s.chart(folder .. "/height.svg", runs, {labels = labels})
local _, frame_rate = s.animate(folder .. "/frames", runs,
  {labels = labels, width = 400, height = 320, frames = 30})
s.video(folder .. "/stiffness.mp4", folder .. "/frames", {frame_rate = frame_rate})
