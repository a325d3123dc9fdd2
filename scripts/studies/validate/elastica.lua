local s = require "springlod"
local cantilever = require "lib.cantilever"
local corrected = require "studies.validate.corrected"

-- Deflection and shortening of the tip over the length, by P L^2 / E I (Mattiasson 1981).
local known = {{1, 0.30172, 0.05643}, {2, 0.49346, 0.16064}, {5, 0.71379, 0.38763},
               {10, 0.81061, 0.55500}}

local length = cantilever.slenderness * cantilever.height
local bending = cantilever.young * cantilever.height ^ 4 / 12
local poisson = 0.25

local quantities = {}
for _, row in ipairs(known) do
  quantities[#quantities + 1] = {name = ("PL^2/EI = %d"):format(row[1]),
                                 reference = row[2], goal = 1, level_goals = {2, 2}}
end

-- The mean deflection of the end face of the base under a force on it.
local function deflection(model, force, held, end_face, level)
  local of_nodes = {}
  for number, share in pairs(end_face) do
    local node = level.group_of(number)
    local sum = of_nodes[node] or {0, 0, 0}
    sum[3] = sum[3] + force * share
    of_nodes[node] = sum
  end
  local bent = s.deflect(model, {large = true, anchored = held, force = of_nodes})
  local of_base, mean = level.to_base(bent.displacement), 0
  for number, share in pairs(end_face) do mean = mean + share * of_base[number][3] end
  return mean / length
end

local plain = {
  name = "elastica",
  title = "Elastica",
  text = "A bar, 20 times as long as high, is clamped at one end and bends far under a force "
    .. "across it at the other: deflection of the tip over the length. The levels are fitted to "
    .. "the clamped bar.",
  source = "Elliptic integrals (Bisshopp and Drucker 1945; values of Mattiasson 1981). The theory "
    .. "has no shear, which adds 0.2 % under a small force.",
  size_name = "cells across", sizes = {4, 6, 8}, quick = {4}, fitted = true,
  quantities = quantities,
  body = function(cells) return cantilever.model({}, cells, poisson) end,
  anchored = cantilever.clamped,
  measure = function(model, cells, level)
    local held = level.carried(cantilever.clamped(cells))
    local end_face, values = cantilever.end_face(level.base, cells), {}
    for i, row in ipairs(known) do
      values[i] = deflection(model, row[1] * bending / length ^ 2, held, end_face, level)
    end
    return values
  end,
}

local twin = corrected(plain, "elastica_corrected")
twin.body = function(cells) return cantilever.model({bending = "corrected"}, cells, poisson) end

return {plain, twin}
