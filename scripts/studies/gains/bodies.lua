-- The bodies of the gains study: those of the picks study, which are small, and a block that is
-- large enough for the time of a step to be in its springs.

local lattices = require "lib.lattices"
local small = require "studies.picks.bodies"

local rubber = {young = "1 MPa", density = 1100, damping = "0.3 ms"}

local bodies = table.move(small, 1, #small, 1, {})
bodies[#bodies + 1] = {name = "block", make = lattices.filled(0.05, {12, 12, 12},
  {rubber = rubber}, function() return "rubber" end)}

return bodies
