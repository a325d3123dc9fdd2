-- Two rods and a joint, thrown at a wall:  springlod run samples/dumbbell.lua -- [FOLDER]
local s = require "springlod"
local folder = arg[1] or "out/dumbbell"

local mesh = s.import(s.samples .. "/dumbbell.obj", {unit = "dm", up = "z"})
local grid = s.voxelize(mesh, {
  cell = "10 cm",
  materials = dofile(s.samples .. "/dumbbell_materials.lua"),
})
local base = s.lattice(grid)
print(base)

-- Priority grouping merges nodes of similar stiffness and density first: the joint stays soft.
local chain = s.simplify(base, {levels = 2, grouping = "priority", border = "weak"})
print(chain)
s.save(folder .. "/dumbbell.glb", chain)

local runs = s.compare(chain, s.scenario(dofile(s.samples .. "/throw_at_wall.lua")), {starts = 4})
local rows = runs:table()
print(s.format_table(rows, {columns = {"label", "nodes", "cost_ratio", "surface_error_percent"}}))
s.render(folder .. "/levels.png", {chain[0], chain[1], chain[2]},
  {width = 480, height = 360, surface = false, springs = true, nodes = true})
s.animate(folder .. "/frames", runs, {frames = 30})
