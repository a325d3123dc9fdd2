-- Ways to give a lattice of cells any Poisson's ratio: springs of its shear modulus, and energies
-- that add the bulk modulus that they lack. Edges of cells have length 1, E is 1.

local energies = require "studies.poisson_ways.energies"

local ways = {}

-- Stiffness of face diagonals over that of cube diagonals, of Golec et al.
local golec_ratio = 1

local function shear_modulus(poisson) return 1 / (2 * (1 + poisson)) end

-- docs/method.md, eq. 8b
local function lacking_bulk_modulus(poisson)
  return (4 * poisson - 1) / (2 * (1 + poisson) * (1 - 2 * poisson))
end

local function scaled(vector, factor)
  return {vector[1] * factor, vector[2] * factor, vector[3] * factor}
end

-- stiffness: that of a cell for its edges, face diagonals and cube diagonals.
local function add_springs(list, lattice, stiffness)
  for _, spring in ipairs(lattice.springs) do
    local one = stiffness[spring.axes] * spring.cells
    local unit = scaled(spring.along, 1 / math.sqrt(spring.axes))
    if one > 0 then
      list[#list + 1] = energies.energy(one, {{spring.a, scaled(unit, -1)}, {spring.b, unit}})
    end
  end
end

-- The mean volume strain of each cell, from its mean deformation gradient.
local function add_cells(list, lattice, bulk)
  for _, cell in ipairs(lattice.cells) do
    local parts = {}
    for corner, node in ipairs(cell) do
      local function sign(axis) return ((corner - 1) >> axis & 1) * 2 - 1 end
      parts[corner] = {node, {sign(0) / 4, sign(1) / 4, sign(2) / 4}}
    end
    list[#list + 1] = energies.energy(bulk, parts)
  end
end

-- springlod, in small displacements (docs/method.md, eq. 4 and 8a to 8c).
local function cell_energies(lattice, poisson)
  local list, k = {}, shear_modulus(poisson)
  add_springs(list, lattice, {k / 4, k / 2, 0})
  add_cells(list, lattice, lacking_bulk_modulus(poisson))
  return list
end

-- Golec et al. (2020). Isotropy fixes one of the two ratios of the three stiffnesses.
local function cube_diagonals(lattice, poisson)
  local list, cube = {}, 3 * shear_modulus(poisson) / (3 * golec_ratio + 4)
  add_springs(list, lattice, {cube * (golec_ratio + 8 / 3) / 4, cube * golec_ratio / 2, cube})
  add_cells(list, lattice, lacking_bulk_modulus(poisson))
  return list
end

-- After the description of Kot and Nagahashi (2015): each node spreads a fraction of the tension of
-- its springs over all of its springs. The weights of springs are k L both in the sum and in
-- spreading it, a choice of ours: the forces then follow from the energy of the mean strain of a
-- node's springs, a third of its volume strain.
local function node_energies(lattice, poisson)
  local list, parts, sums, k = {}, {}, {}, shear_modulus(poisson)
  local stiffness = {k / 4, k / 2, 0}
  add_springs(list, lattice, stiffness)
  for node in ipairs(lattice.masses) do parts[node], sums[node] = {}, 0 end
  for _, spring in ipairs(lattice.springs) do
    local one = stiffness[spring.axes] * spring.cells
    for _, node in ipairs{spring.a, spring.b} do
      table.insert(parts[node], {spring.a, scaled(spring.along, -one)})
      table.insert(parts[node], {spring.b, scaled(spring.along, one)})
      sums[node] = sums[node] + one * spring.axes -- the square of its length
    end
  end
  -- The tension that a uniform compression of all springs adds to them, over their own.
  local fraction = 3 * lacking_bulk_modulus(poisson) / (5 * k)
  for node, list_of_node in ipairs(parts) do
    list[#list + 1] = energies.energy(fraction / (2 * sums[node]), list_of_node)
  end
  return list
end

-- springs: per cell of a large body. nodes: on which the energy of a cell or node depends.
ways[1] = {name = "cell terms", make = cell_energies, springs = 9, nodes = 8}
ways[2] = {name = "cube diagonals", make = cube_diagonals, springs = 13, nodes = 8}
ways[3] = {name = "node terms", make = node_energies, springs = 9, nodes = 19}

return ways
