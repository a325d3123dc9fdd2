-- An organic shape of 20,000 triangles, dropped:  springlod run samples/beast.lua -- [FOLDER]
local s = require "springlod"
local folder = arg[1] or "out/beast"

local mesh = s.import(s.samples .. "/beast.obj", {unit = "cm", up = "z"})
-- A skeleton: cells deeper than 8 mm are ten times as stiff.
local grid = s.voxelize(mesh, {
  cell = "4 mm",
  materials = dofile(s.samples .. "/beast_materials.lua"),
  core = {
    depth = "8 mm",
    material = {name = "bone", young = "0.6 MPa", density = 1000, damping = "0.1 ms",
      colour = "#efe6d0"},
  },
})
local base = s.lattice(grid, {hinges = "fill"})
print(base)

local chain = s.simplify(base, {levels = 2, grouping = "priority", border = "weak"})
print(chain)
s.save(folder .. "/beast.glb", chain)

local runs = s.compare(chain, s.scenario(dofile(s.samples .. "/drop.lua")))
s.chart(folder .. "/cost-error.svg", runs)
s.animate(folder .. "/frames", runs, {frames = 24, slow = 2})
