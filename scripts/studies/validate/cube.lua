local s = require "springlod"
local bodies = require "studies.validate.bodies"
local shares = require "studies.validate.shares"

local function cos(x) return math.cos(math.pi * x) end
local function sin(x) return math.sin(math.pi * x) end

-- The Lamé modes of a unit cube. Their sum vanishes, so two of them are independent.
local fields = {
  function(x, y) return cos(x) * sin(y), -sin(x) * cos(y), 0 end,
  function(_, y, z) return 0, cos(y) * sin(z), -sin(y) * cos(z) end,
}

return {
  name = "cube",
  title = "Lamé mode of a cube",
  text = "A free cube of edge a vibrates without a change of volume and without stress on its "
    .. "faces. The solution is exact, and the same for any Poisson's ratio.",
  source = "Lamé 1852; the frequency is omega a / c_t = pi sqrt(2).",
  size_name = "cells along an edge", sizes = {4, 8, 16}, quick = {4, 8}, fitted = true,
  quantities = {{name = "omega a / c_t", reference = math.pi * math.sqrt(2), goal = 0.1}},
  body = function(cells) return bodies.box({1, 1, 1}, cells) end,
  measure = function(model)
    local frequency = shares.frequency(model, s.modes(model, {count = 24}), fields, 2)
    return {frequency and 2 * math.pi * frequency / bodies.shear_speed or false}
  end,
}
