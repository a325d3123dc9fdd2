local s = require "springlod"

local young, stiffer = 1e6, 4e6 -- [Pa]
local ratios = {-0.2, -0.1, 0, 0.1, 0.25, 0.3, 0.4, 0.45, 0.49, 0.495}
local random_ratios = {-0.1, 0, 0.1, 0.25, 0.4, 0.45, 0.49}

-- The cells of a bar of 1 m x 1 m x 2 m, of which the left quarter may be of a stiffer material.
local function grid(cells, poisson, two)
  return s.grid{
    cell = 1 / cells, size = {cells, cells, 2 * cells},
    materials = {soft = {young = young, density = 1000, damping = 0, poisson = poisson},
                 hard = {young = stiffer, density = 1000, damping = 0, poisson = poisson}},
    fill = function(x) return two and x < 0.25 and "hard" or "soft" end,
  }
end

-- Largest errors of Young's modulus, relative, and of Poisson's ratio.
local function largest_errors(list, expected, measure)
  local of_young, of_poisson = 0, 0
  for _, poisson in ipairs(list) do
    local found = measure(poisson)
    of_young = math.max(of_young, math.abs(found.young / expected - 1))
    of_poisson = math.max(of_poisson, math.abs(found.poisson - poisson))
  end
  return of_young, of_poisson
end

local function mean_over_axes(model)
  local mean = {young = 0, poisson = 0}
  for _, axis in ipairs{"x", "y", "z"} do
    local found = s.stretch(model, {axis = axis})
    mean.young = mean.young + found.young / 3
    mean.poisson = mean.poisson + found.poisson / 3
  end
  return mean
end

local function lattice(cells, poisson, two) return s.lattice(grid(cells, poisson, two)) end

return {
  name = "stretch",
  title = "Stretched bar",
  text = "A bar is stretched; its ends are free to contract. The errors are the largest over "
    .. "Poisson's ratios from -0.2 to 0.495; of models of random nodes, as many as cells, over "
    .. "ratios from -0.1 to 0.49, as means over the three axes.",
  source = "what the material asks for; of two materials side by side, the mean of their moduli by "
    .. "area.",
  size_name = "cells across", sizes = {4, 8, 12}, quick = {4},
  quantities = {
    {name = "error of E", reference = 0, goal = 0.001},
    {name = "error of nu", reference = 0, goal = 0.001},
    {name = "error of E, two materials", reference = 0, goal = 0.001},
    {name = "error of nu, two materials", reference = 0, goal = 0.001},
    {name = "error of E, random", reference = 0, goal = 0.02},
    {name = "error of nu, random", reference = 0, goal = 0.02},
  },
  body = function(cells) return lattice(cells, 0.45, false) end,
  measure = function(_, cells)
    local values = {}
    local function add(list, expected, measure)
      values[#values + 1], values[#values + 2] = largest_errors(list, expected, measure)
    end
    add(ratios, young, function(nu) return s.stretch(lattice(cells, nu, false)) end)
    add(ratios, (3 * young + stiffer) / 4, function(nu)
      return s.stretch(lattice(cells, nu, true))
    end)
    add(random_ratios, young, function(nu) return mean_over_axes(s.random(grid(cells, nu))) end)
    return values
  end,
}
