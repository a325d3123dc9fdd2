local s = require "springlod"
local corrected = require "studies.validate.corrected"
local smooth_loads = require "studies.validate.smooth_loads"
local block = require "studies.validate.two_material_block"

-- The ten lowest frequencies by CalculiX 2.20, 16 x 12 x 8 quadratic hexahedra [Hz]: what
-- tests/peers/calculix.lua prints last for each ratio. With half as many cells along each edge,
-- they are up to 0.35 % higher.
local frequencies = {
  [0.25] = {5.13293, 6.38206, 7.33752, 8.78422, 8.81862, 9.26192, 9.45262, 9.79593, 10.40315,
            10.98804},
  [0.45] = {4.78106, 6.30125, 7.14797, 8.36896, 8.61000, 8.86607, 8.90073, 9.52596, 10.11237,
            10.41881},
}

-- Compliances under the nine smooth loads of 1 N by 32 x 24 x 16 of them, in the order of
-- smooth_loads.list [J]. With 24 x 18 x 12 they are up to 0.01 % lower at 0.25, 0.06 % at 0.45.
local compliances = {
  [0.25] = {1.094482e-07, 5.773902e-08, 2.606502e-08, 4.092016e-08, 3.977508e-08, 9.665464e-08,
            1.465447e-07, 1.459579e-07, 4.395113e-07},
  [0.45] = {1.044644e-07, 5.681346e-08, 2.493856e-08, 4.701938e-08, 4.544498e-08, 1.109790e-07,
            1.419966e-07, 1.403811e-07, 5.081122e-07},
}
-- The largest error of 32 x 24 x 16 linear hexahedra, whose references are the same.
local linear_hexahedra = {[0.25] = "0.6 %", [0.45] = "1.3 %"}

local function error_of_frequencies(model, poisson)
  local modes, largest = s.modes(model, {count = 10}), 0
  for i, reference in ipairs(frequencies[poisson]) do
    if not modes[i] then return false end
    largest = math.max(largest, math.abs(modes[i].frequency / reference - 1))
  end
  return largest
end

-- Forces on the nodes of a level: on each, the sum of those on the nodes of its group.
local function summed(force, level)
  local sums = {}
  for number, f in ipairs(force) do
    local node = level.group_of(number)
    local sum = sums[node] or {0, 0, 0}
    for d = 1, 3 do sum[d] = sum[d] + f[d] end
    sums[node] = sum
  end
  return sums
end

-- A volume and a place relative to the centre of the block: of a node, as s.static_loads takes
-- them; and of its shape function, which is linear in each cell: its integral and its centroid.
-- The integral times the field there does the same work as the field over the cells.
local function of_nodes(node)
  return node.volume, {node.x - block.size[1] / 2, node.y - block.size[2] / 2,
                       node.z - block.size[3] / 2}
end
local function of_shape_functions(node, cells)
  local _, place = of_nodes(node)
  local volume = cells ^ -3
  for d = 1, 3 do
    local inside = block.size[d] / 2 - math.abs(place[d])
    if inside < 0.5 / cells then
      volume = volume / 2
      place[d] = place[d] < 0 and place[d] + 1 / (3 * cells) or place[d] - 1 / (3 * cells)
    end
  end
  return volume, place
end

local sums = {} -- of the magnitudes of the loads' fields over the block, by load
local function sum_of(load)
  sums[load] = sums[load] or smooth_loads.sum(load.field, block.size)
  return sums[load]
end

-- Largest error of the compliances. Each load is a field over the block, scaled so that its
-- magnitude has the integral 1 N, in CalculiX as here.
local function error_of_loads(model, poisson, cells, level, of_node)
  local largest, nodes = 0, level.base:nodes()
  for i, load in ipairs(smooth_loads.list) do
    local force, sum = {}, sum_of(load)
    for number, node in ipairs(nodes) do
      local volume, place = of_node(node, cells)
      local f, share = load.field(table.unpack(place)), volume / sum
      force[number] = {share * f[1], share * f[2], share * f[3]}
    end
    local found = s.deflect(model, {force = summed(force, level)}).compliance
    largest = math.max(largest, math.abs(found / compliances[poisson][i] - 1))
  end
  return largest
end

-- `options` of s.lattice.
local function problem(name, poisson, options)
  return {
    name = name,
    title = ("Block of two materials, nu = %g"):format(poisson),
    text = ("A free block of 2 m x 1.5 m x 1 m, of which one half is four times as stiff as the "
      .. "other: the largest error, as a fraction, of its ten lowest frequencies, and of its "
      .. "compliances under the nine loads of `s.static_loads`. These are forces per volume, which "
      .. "inertia balances; their magnitude integrated over the block is 1 N. The nodes get "
      .. "consistent forces, which do the same work; `s.static_loads` takes the field at each node "
      .. "instead (field at nodes). Linear hexahedra of the finest size, integrated fully (C3D8), "
      .. "have errors of the compliances up to %s."):format(linear_hexahedra[poisson]),
    source = "CalculiX 2.20, quadratic hexahedra (tests/peers/calculix.lua).",
    size_name = "cells per metre", sizes = {4, 8, 16}, quick = {2, 4}, fitted = true,
    quantities = {{name = "error of f1 to f10", reference = 0, goal = 0.01},
                  {name = "error of nine loads", reference = 0, goal = 0.01},
                  {name = "error, field at nodes", reference = 0}},
    body = function(cells)
      local materials = {}
      for material, young in pairs(block.young) do
        materials[material] = {young = young, density = block.density, damping = 0,
                               poisson = poisson}
      end
      return s.lattice(s.grid{
        cell = 1 / cells, materials = materials, fill = block.material_at,
        size = {math.floor(block.size[1] * cells), math.floor(block.size[2] * cells + 0.5),
                math.floor(block.size[3] * cells)},
      }, options)
    end,
    measure = function(model, cells, level)
      return {error_of_frequencies(model, poisson),
              error_of_loads(model, poisson, cells, level, of_shape_functions),
              error_of_loads(model, poisson, cells, level, of_nodes)}
    end,
  }
end

local problems = {}
for i, name in ipairs{"two_materials", "two_materials_45"} do
  problems[i] = problem(name, block.ratios[i])
end
for i, name in ipairs{"two_materials_corrected", "two_materials_45_corrected"} do
  problems[#problems + 1] = corrected(problem(name, block.ratios[i], {bending = "corrected"}), name)
end
return problems
