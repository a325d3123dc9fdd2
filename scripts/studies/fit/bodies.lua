-- The bodies of the fit study. Defaults of the fit were chosen on those of "samples" (meshes of
-- samples/) and are reported for the others: those of the accuracy study that are no samples, and
-- three with features that these lack (slender prongs, layers, holes). Those of "firm" are for
-- landings: so stiff that the motion of a level after an impact depends on its contact. They have
-- the default damping.

local accuracy_bodies = require "studies.accuracy.bodies"
local lattices = require "lib.lattices"

local filled = lattices.filled

local function sample(name, unit, cell, core)
  return lattices.sample(name,
    {unit = unit, cell = cell, core = core, materials = name .. "_materials"})
end

local rubber = {young = "1 MPa", density = 1100, damping = "0.2 ms"}
local steel = {young = "20 MPa", density = 2000, damping = "0.05 ms"}

-- A fork: a handle and two slender prongs, 3 cells thick.
local fork = filled(0.01, {24, 9, 3}, {rubber = rubber}, function(x, y)
  return (x < 0.05 or y < 0.03 or y > 0.06) and "rubber" or nil
end)

-- A block of five layers, of which the second and the fourth are twenty times as stiff.
local layers = filled(0.01, {12, 9, 10}, {rubber = rubber, steel = steel}, function(_, _, z)
  local layer = math.floor(z / 0.02)
  return layer % 2 == 1 and "steel" or "rubber"
end)

-- A thick plate with two holes and a stiff corner.
local plate = filled(0.01, {18, 12, 4}, {rubber = rubber, steel = steel}, function(x, y)
  if (x - 0.05) ^ 2 + (y - 0.06) ^ 2 < 0.025 ^ 2 then return nil end
  if (x - 0.13) ^ 2 + (y - 0.05) ^ 2 < 0.02 ^ 2 then return nil end
  return x > 0.14 and y > 0.08 and "steel" or "rubber"
end)

local firm = {young = "20 MPa", density = 1000}
local softer = {young = "5 MPa", density = 1000}

local function firm_block(size)
  return filled(0.01, size, {firm = firm}, function() return "firm" end)
end

local two_material_bar = filled(0.01, {7, 7, 30}, {firm = firm, softer = softer}, function(_, _, z)
  return z < 0.15 and "firm" or "softer"
end)

local bodies = {
  {name = "beast sample", set = "samples", make = sample("beast", "cm", "6 mm", {
    depth = "8 mm",
    material = {name = "bone", young = "0.6 MPa", density = 1000, damping = "0.1 ms"},
  })},
  {name = "ball sample", set = "samples", make = sample("ball", "dm", "10 cm")},
  {name = "dumbbell sample", set = "samples", make = sample("dumbbell", "dm", "10 cm")},
}
for _, body in ipairs(accuracy_bodies) do
  if body.name ~= "beast" then
    bodies[#bodies + 1] = {name = body.name, set = "others", make = body.make}
  end
end
bodies[#bodies + 1] = {name = "fork", set = "others", make = fork}
bodies[#bodies + 1] = {name = "layers", set = "others", make = layers}
bodies[#bodies + 1] = {name = "plate", set = "others", make = plate}
bodies[#bodies + 1] = {name = "bar", set = "firm", make = firm_block{7, 7, 30}}
bodies[#bodies + 1] = {name = "block", set = "firm", make = firm_block{12, 12, 12}}
bodies[#bodies + 1] = {name = "two-material bar", set = "firm", make = two_material_bar}

return bodies
