local s = require "springlod"
local block = require "studies.validate.two_material_block"

-- The ten lowest frequencies by CalculiX 2.20, 16 x 12 x 8 quadratic hexahedra [Hz]: what
-- tests/peers/calculix.lua prints last for each ratio. With half as many cells along each edge,
-- they are up to 0.35 % higher.
local references = {
  [0.25] = {5.13293, 6.38206, 7.33752, 8.78422, 8.81862, 9.26192, 9.45262, 9.79593, 10.40315,
            10.98804},
  [0.45] = {4.78106, 6.30125, 7.14797, 8.36896, 8.61000, 8.86607, 8.90073, 9.52596, 10.11237,
            10.41881},
}

local function problem(name, poisson)
  return {
    name = name,
    title = ("Block of two materials, nu = %g"):format(poisson),
    text = "A free block of 2 m x 1.5 m x 1 m, of which one half is four times as stiff as the "
      .. "other: the largest error of its ten lowest frequencies, as a fraction.",
    source = "CalculiX 2.20, quadratic hexahedra (tests/peers/calculix.lua).",
    size_name = "cells per metre", sizes = {4, 8, 16}, quick = {3, 6}, fitted = true,
    quantities = {{name = "error of f1 to f10", reference = 0, goal = 0.01}},
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
      })
    end,
    measure = function(model)
      local modes, largest = s.modes(model, {count = 10}), 0
      for i, reference in ipairs(references[poisson]) do
        if not modes[i] then return {false} end
        largest = math.max(largest, math.abs(modes[i].frequency / reference - 1))
      end
      return {largest}
    end,
  }
end

local problems = {}
for i, name in ipairs{"two_materials", "two_materials_45"} do
  problems[i] = problem(name, block.ratios[i])
end
return problems
