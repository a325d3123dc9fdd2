-- The bodies of the accuracy study: four regular lattices defined by formulas, and three of other
-- kinds (an imported mesh with a core, a thin L-shaped bracket, a random model of two materials
-- with a hole). They were chosen before any method was tuned.

local s = require "springlod"
local scenes = require "studies.paper.scenes"

-- A block of one material with 10 cm cells and a node at the center of each.
local function block(size)
  return function()
    local grid = s.grid{
      cell = 0.1, size = size, fill = function() return "block" end,
      materials = {block = {young = "1 MPa", density = 1000, damping = "2 ms"}},
    }
    return s.lattice(grid, {style = "centers"}), grid, "centers"
  end
end

local function beast()
  local mesh = s.import(s.samples .. "/beast.obj", {unit = "cm", up = "z"})
  local grid = s.voxelize(mesh, {
    cell = "6 mm",
    materials = dofile(s.samples .. "/beast_materials.lua"),
    core = {
      depth = "8 mm",
      material = {name = "bone", young = "0.6 MPa", density = 1000, damping = "0.1 ms"},
    },
  })
  return s.lattice(grid, {hinges = "fill"}), grid, "corners"
end

-- An L-shaped bracket, 3 cells thick, with legs of 20 and 11 cells.
local function bracket()
  local grid = s.grid{
    cell = 0.01, size = {20, 6, 11}, materials = {alloy = {young = "20 MPa", density = 1200,
      damping = "0.1 ms"}},
    fill = function(x, _, z) return (z < 0.03 or x < 0.03) and "alloy" or nil end,
  }
  return s.lattice(grid), grid, "corners"
end

-- A flat ring of mean radius 8 cm, 6 cm wide and 4 cm high; one half is five times as stiff as the
-- other.
local function ring()
  local grid = s.grid{
    cell = 0.005, size = {44, 44, 8}, origin = {-0.11, -0.11, 0},
    materials = {
      hard = {young = "1 MPa", density = 1100, damping = "1 ms"},
      soft = {young = "0.2 MPa", density = 900, damping = "1 ms"},
    },
    fill = function(x, y)
      local radius = math.sqrt(x * x + y * y)
      if radius < 0.05 or radius > 0.11 then return nil end
      return x > 0 and "hard" or "soft"
    end,
  }
  return s.random(grid, {nodes = 900, seed = 1}), grid, "corners"
end

local function centers(make)
  return function()
    local base, grid = make()
    return base, grid, "centers"
  end
end

-- `make` returns the base, its grid and the lattice style for a refill.
return {
  {name = "sphere", make = centers(scenes.ball)},
  {name = "rods", make = centers(scenes.rods)},
  {name = "beam", make = block{4, 4, 20}},
  {name = "cube", make = block{8, 8, 8}},
  {name = "beast", make = beast},
  {name = "bracket", make = bracket},
  {name = "ring", make = ring},
}
