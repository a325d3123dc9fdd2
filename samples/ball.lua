-- A core in a soft shell, thrown horizontally:  springlod run samples/ball.lua -- [FOLDER]
local s = require "springlod"
local folder = arg[1] or "out/ball"

local mesh = s.import(s.samples .. "/ball.obj", {unit = "dm", up = "z"})
local grid = s.voxelize(mesh, {
  cell = "10 cm",
  materials = dofile(s.samples .. "/ball_materials.lua"),
  priority = {"core"}, -- cells in both parts become core
})
local base = s.lattice(grid, {style = "centers"})
print(base)

local chain = s.simplify(base, {levels = 2, border = "weak"})
print(chain)
s.save(folder .. "/ball.glb", chain)

-- The energy ledger of the base at the end of the run.
local run = s.run(chain[0], dofile(s.samples .. "/roll.lua"))
local last = run.ledger[#run.ledger]
print(("after %.2f s: initial energy %.4g J, from falling %.4g J; now %.4g J; lost to damping "
  .. "%.4g J, to friction %.4g J, to contact %.2g J"):format(last.time, run.ledger[1].total,
  -last.gravity, last.kinetic + last.elastic + last.contact, last.lost_damping,
  last.lost_friction, last.lost_contact))
s.csv(folder .. "/ledger.csv", run.ledger)
s.render(folder .. "/levels.png", {chain[0], chain[1], chain[2]},
  {width = 480, height = 400, springs = true, nodes = true, surface_opacity = 0.35})
