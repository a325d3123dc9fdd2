-- The bodies of the picks study. The constants of the prediction were chosen on those of the set
-- "tuning"; the others check it. They are small, so that the base runs quickly.

local lattices = require "lib.lattices"

local filled = lattices.filled

local function sample(name, materials)
  return lattices.sample(name, {unit = "dm", cell = "14 cm", materials = materials})
end

local rubber = {young = "1 MPa", density = 1100, damping = "0.3 ms"}
local soft = {young = "0.1 MPa", density = 1000, damping = "1 ms"}
local foam = {young = "0.3 MPa", density = 900, damping = "0.5 ms"}
local steel = {young = "10 MPa", density = 2000, damping = "0.1 ms"}

local function all() return "rubber" end

return {
  {name = "firm ball", set = "tuning", make = sample("ball", "firm_ball_materials")},
  {name = "dumbbell", set = "tuning", make = sample("dumbbell", "dumbbell_materials")},
  {name = "cube", set = "tuning", make = filled(0.1, {5, 5, 5}, {rubber = rubber}, all)},
  {name = "soft beam", set = "tuning", make = filled(0.1, {3, 3, 12}, {rubber = soft}, all)},
  {name = "fork", set = "checking", make = filled(0.02, {13, 6, 2}, {rubber = rubber},
    function(x, y) return (x < 0.06 or y < 0.04 or y > 0.08) and "rubber" or nil end)},
  {name = "layers", set = "checking", make = filled(0.02, {6, 5, 5},
    {rubber = rubber, steel = steel},
    function(_, _, z) return z > 0.04 and z < 0.06 and "steel" or "rubber" end)},
  {name = "sphere", set = "checking", make = filled(0.03, {8, 8, 8}, {foam = foam},
    function(x, y, z)
      return (x - 0.12) ^ 2 + (y - 0.12) ^ 2 + (z - 0.12) ^ 2 < 0.115 ^ 2 and "foam" or nil
    end)},
  {name = "bracket", set = "checking", make = filled(0.03, {9, 3, 6}, {foam = foam},
    function(x, _, z) return (z < 0.09 or x < 0.09) and "foam" or nil end)},
}
