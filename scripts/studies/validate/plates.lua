local s = require "springlod"
local pad = require "studies.validate.pad"

-- The force that presses the block, over young * press * area, by CalculiX 2.20 with 24 x 24 x 12
-- quadratic hexahedra: what tests/peers/calculix.lua prints last for each ratio. With 16 cells per
-- metre it is 0.5 and 1.0 % higher, with 8 2.2 and 4.6 %: the edges of the plates are singular.
local references = {[0.45] = 1.45377, [0.49] = 1.64231}

local function on_plates(cells)
  local near = 0.25 / cells
  return function(node) return node.z < near end,
         function(node) return node.z > pad.size[3] - near end
end

local function problem(poisson)
  return {
    name = ("plates_%g"):format(100 * poisson),
    title = ("Block between plates, nu = %g"):format(poisson),
    text = "A block of 1 m x 1 m x 0.5 m is pressed between two plates to which its faces stick: "
      .. "the force, over Young's modulus, strain and area. A block that could slide would have 1.",
    source = "CalculiX 2.20, quadratic hexahedra of the finest size (tests/peers/calculix.lua).",
    size_name = "cells per metre", sizes = {8, 16, 24}, quick = {4, 8},
    quantities = {{name = "F / E strain A", reference = references[poisson], goal = 2}},
    body = function(cells)
      return s.lattice(s.grid{
        cell = 1 / cells, fill = function() return "pad" end,
        size = {pad.size[1] * cells, pad.size[2] * cells, math.floor(pad.size[3] * cells)},
        materials = {pad = {young = pad.young, damping = 0, poisson = poisson}},
      })
    end,
    measure = function(model, cells)
      local low, high = on_plates(cells)
      local bent = s.deflect(model, {large = true, anchored = {
        {name = "table", nodes = low},
        {name = "press", nodes = high,
         path = {{time = 1, move = {0, 0, -pad.press * pad.size[3]}}}},
      }})
      return {-bent.anchor_loads[2].force[3]
              / (pad.young * pad.press * pad.size[1] * pad.size[2])}
    end,
  }
end

return {problem(pad.ratios[1]), problem(pad.ratios[2])}
