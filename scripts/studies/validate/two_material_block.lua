-- A free block of two materials, side by side along its longest edge.

local block = {}

block.size = {2, 1.5, 1} -- [m]
block.young = {soft = 1e6, hard = 4e6} -- [Pa]
block.density = 1000 -- [kg/m3]
block.ratios = {0.25, 0.45} -- of Poisson

function block.material_at(x) return x < block.size[1] / 2 and "soft" or "hard" end

return block
