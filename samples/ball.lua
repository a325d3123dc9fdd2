-- A core in a soft shell, thrown flat:  springlod run samples/ball.lua -- [FOLDER]
local s = require "springlod"
local folder = arg[1] or "out/ball"

local mesh = s.import(s.samples .. "/ball.obj", {unit = "dm", up = "z"})
local grid = s.voxelize(mesh, {
  cell = "10 cm",
  materials = dofile(s.samples .. "/ball_materials.lua"),
  priority = {"core"}, -- the core claims its cells before the shell around it does
})
local base = s.lattice(grid, {style = "centers"})
print(base)

local chain = s.simplify(base, {levels = 2, border = "weak"})
print(chain)
s.save(folder .. "/ball.glb", chain)

-- The energy ledger of the base: where its energy is at the end.
local run = s.run(chain[0], dofile(s.samples .. "/roll.lua"))
local last = run.ledger[#run.ledger]
print(("after %.2f s: of %.4g J thrown and %.4g J fallen, %.4g J left, %.4g J lost to damping, "
  .. "%.4g J to friction, %.2g J to contact"):format(last.time, run.ledger[1].total, -last.gravity,
  last.kinetic + last.elastic + last.contact, last.lost_damping, last.lost_friction,
  last.lost_contact))
s.csv(folder .. "/ledger.csv", run.ledger)
s.render(folder .. "/levels.png", {chain[0], chain[1], chain[2]},
  {width = 480, height = 400, springs = true, nodes = true, surface_opacity = 0.35})
