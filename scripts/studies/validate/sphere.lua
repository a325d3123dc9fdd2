local s = require "springlod"
local bodies = require "studies.validate.bodies"
local shares = require "studies.validate.shares"
local twin = require "studies.validate.twin"

-- The harmonic polynomials of degree 2 and their gradients.
local harmonics = {
  {function(x, y) return x * y end, function(x, y) return y, x, 0 end},
  {function(_, y, z) return y * z end, function(_, y, z) return 0, z, y end},
  {function(x, _, z) return x * z end, function(x, _, z) return z, 0, x end},
  {function(x, y) return (x * x - y * y) / 2 end, function(x, y) return x, -y, 0 end},
  {function(x, y, z) return z * z - (x * x + y * y) / 2 end,
   function(x, y, z) return -x, -y, 2 * z end},
}

local function radius2(x, y, z) return x * x + y * y + z * z end

-- A field times 1, and times the square of the radius.
local function with_powers(fields, field)
  fields[#fields + 1] = field
  fields[#fields + 1] = function(x, y, z)
    local a, b, c = field(x, y, z)
    local factor = radius2(x, y, z)
    return a * factor, b * factor, c * factor
  end
end

local function times_position(value)
  return function(x, y, z)
    local v = value(x, y, z)
    return v * x, v * y, v * z
  end
end

local function across_gradient(gradient)
  return function(x, y, z)
    local a, b, c = gradient(x, y, z)
    return y * c - z * b, z * a - x * c, x * b - y * a
  end
end

-- Fields of the lowest degree with the symmetry of each kind of mode: enough to tell them apart.
local torsion, ellipsoid, dipole, breathing = {}, {}, {}, {}
for _, harmonic in ipairs(harmonics) do
  local value, gradient = harmonic[1], harmonic[2]
  with_powers(torsion, across_gradient(gradient))
  with_powers(ellipsoid, gradient)
  ellipsoid[#ellipsoid + 1] = times_position(value)
end
for axis = 1, 3 do
  with_powers(dipole, function()
    return axis == 1 and 1 or 0, axis == 2 and 1 or 0, axis == 3 and 1 or 0
  end)
  dipole[#dipole + 1] = times_position(function(...) return (select(axis, ...)) end)
end
with_powers(breathing, times_position(function() return 1 end))

local kinds = {
  {fields = torsion, count = 5}, {fields = ellipsoid, count = 5},
  {fields = dipole, count = 3}, {fields = breathing, count = 1},
}

local function quantities(goals)
  return {
    {name = "0T2", reference = 2.50113, goal = goals[1]},
    {name = "0S2", reference = 2.63987, goal = goals[2]},
    {name = "0S1", reference = 3.42453, goal = goals[3]},
    {name = "0S0", reference = 4.44000, goal = goals[4]},
  }
end

local whole = {
  name = "sphere",
  title = "Vibrations of a sphere",
  text = "Free vibrations of a sphere of radius R: the lowest torsional mode (0T2), and the "
    .. "ellipsoidal (0S2), the dipole (0S1) and the breathing mode (0S0). Each is the mean of its "
    .. "five, five, three or one frequencies, which the cells split.",
  source = "Lamb 1882, for Poisson's ratio 1/4; the quantity is omega R / c_t.",
  size_name = "cells across", sizes = {8, 12, 24}, quick = {6, 8}, fitted = true,
  quantities = quantities{1.5, 0.2, 1.5, 1},
  body = bodies.ball,
  measure = function(model)
    local modes, values = s.modes(model, {count = 34}), {}
    for i, kind in ipairs(kinds) do
      local frequency = shares.frequency(model, modes, kind.fields, kind.count)
      values[i] = frequency and 2 * math.pi * frequency * bodies.radius / bodies.shear_speed
        or false
    end
    return values
  end,
}

local cut = twin(whole, {
  name = "sphere_cut", title = whole.title .. ", cut cells",
  text = "The same for a mesh of the sphere, with the option `cut_cells` of `s.voxelize`.",
  quantities = quantities{1, 0.2, 1.2, 0.3}, body = bodies.cut_ball,
})

return {whole, cut}
