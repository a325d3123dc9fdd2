-- The nine loads of s.static_loads, as forces per volume on a box that is longest along x.

local smooth_loads = {}

-- Each with its name, as s.static_loads has it, and its field: {x, y, z} at a place relative to the
-- centre, of any size.
smooth_loads.list = {
  {name = "stretch x", field = function(x) return {x, 0, 0} end},
  {name = "stretch y", field = function(_, y) return {0, y, 0} end},
  {name = "stretch z", field = function(_, _, z) return {0, 0, z} end},
  {name = "shear yz", field = function(_, y, z) return {0, z, y} end},
  {name = "shear xz", field = function(x, _, z) return {z, 0, x} end},
  {name = "shear xy", field = function(x, y) return {y, x, 0} end},
  {name = "bend x to y", field = function(x, y) return {x * y, 0, 0} end},
  {name = "bend x to z", field = function(x, _, z) return {x * z, 0, 0} end},
  {name = "twist x", field = function(x, y, z) return {0, -x * z, x * y} end},
}

function smooth_loads.magnitude(v) return math.sqrt(v[1] ^ 2 + v[2] ^ 2 + v[3] ^ 2) end

local steps = 40 -- along each edge

-- Sum of the magnitudes of the field over a box of this size, by the midpoint rule [N, if the field
-- is in N/m3]. Whoever divides the field by it applies the same load.
function smooth_loads.sum(field, size)
  local sum = 0
  local function at(i, d) return ((i - 0.5) / steps - 0.5) * size[d] end
  for i = 1, steps do
    for j = 1, steps do
      for k = 1, steps do
        sum = sum + smooth_loads.magnitude(field(at(i, 1), at(j, 2), at(k, 3)))
      end
    end
  end
  return sum * size[1] * size[2] * size[3] / steps ^ 3
end

return smooth_loads
