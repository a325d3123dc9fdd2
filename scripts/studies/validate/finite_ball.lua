-- An elastic ball that a rigid plate presses without friction: the force, and how long the ball
-- touches a plate that it hits. Units are the radius, Young's modulus and the density of the ball.
--
-- Hertz takes the ball for a half space near the contact. A whole ball is stiffer: its centre of
-- mass comes nearer to the plate by less. Here it has the general solution for a sphere in Legendre
-- polynomials (Lur'e 1964, chapter 6), with the pressure on the plate on one side, and a uniform
-- body force, gravity or inertia, that balances it. The strains are small, but the contact is not:
-- the face of the ball that touches the plate becomes plane. Sternberg and Rosenthal 1952 and
-- Titovich and Norris 2012 use the same series; tests/peers/calculix.lua compares it with finite
-- elements.
--
-- Depths are of the centre of mass: the distance that it has moved towards the plate since the ball
-- touched the plate without force.

local bodies = require "studies.validate.bodies"
local linear = require "lib.linear"

local finite_ball = {}

local poisson = bodies.poisson
local shear = 1 / (2 * (1 + poisson)) -- modulus
local lame = 2 * shear * poisson / (1 - 2 * poisson) -- the other modulus, lambda
local plane_modulus = 1 / (1 - poisson ^ 2) -- E*
local mass = 4 / 3 * math.pi

-- With these, the force is right to 0.01 %: twice the degrees, or one more function, changes it by
-- less.
local cutoff = 40 -- highest degree of the polynomials, times the angle of contact
local functions = 2 -- of the pressure

-- Displacements of the surface, u_r = u P and u_theta = v dP/dtheta with the Legendre polynomial P
-- of a degree, under the tractions a P and b dP/dtheta. Returns u and v.
local function response(degree, a, b)
  local n = degree
  if n == 0 then return a * (1 - 2 * poisson) / (2 * shear * (1 + poisson)), 0 end
  if n == 1 then
    -- The only degree with a resultant force, which a uniform body force balances. Part of the
    -- displacement is along the axis and proportional to r^2: curved z, which needs a body force.
    -- The rest is the general solution, and a translation that keeps the centre of mass in place.
    local curved = (a + 2 * b) / (2 * (lame + 4 * shear))
    local free = (b - 2 * shear * curved) / (4 * shear * (1 + poisson))
    local moved = curved - (3 / 5 * curved + 2 * free)
    return moved - 2 * (1 - 4 * poisson) * free, moved + (6 - 4 * poisson) * free
  end
  -- Two solutions, proportional to r^(n + 1) and r^(n - 1).
  local radial = {2 * shear * (n + 1) * (n * n - n - 2 - 2 * poisson), 2 * shear * n * (n - 1)}
  local tangential = {2 * shear * (n * n + 2 * n - 1 + 2 * poisson), 2 * shear * (n - 1)}
  local outer, inner = table.unpack(linear.solve({radial, tangential}, {a, b}))
  return (n + 1) * (n - 2 + 4 * poisson) * outer + n * inner,
         (n + 5 - 4 * poisson) * outer + inner
end

-- Points and weights of Gauss's rule with 2 count points, those above 0.
local function gauss_points(count)
  local points, order = {}, 2 * count
  for i = 1, count do
    local x, slope = math.cos(math.pi * (i - 0.25) / (order + 0.5)), nil
    for _ = 1, 6 do -- Newton's method, to machine precision
      local before, value = 1, x
      for n = 1, order - 1 do
        before, value = value, ((2 * n + 1) * x * value - n * before) / (n + 1)
      end
      slope = order * (x * value - before) / (x * x - 1)
      x = x - value / slope
    end
    points[i] = {x, 2 / ((1 - x * x) * slope * slope)}
  end
  return points
end

-- The pressures are combinations of h^(2 k - 1), k = 1, 2, ..., with h = sqrt(1 - s^2), where s is
-- the chord from the pole over that of the edge: Hertz's pressure is h itself. Over the area of the
-- contact, 2 pi `area` h dh, a pressure times a polynomial of the cosine is then an even
-- polynomial of h.

-- Integral of h^(2 k - 1) over the contact, over 2 pi.
local function integral(k, area) return area / (2 * k + 1) end

-- The terms of each degree of the tractions -h^(2 k - 1) along the axis, k = 0, 1, ...: calls
-- visit(degree, radial, tangential) with the integrals of the tractions times P and dP/dtheta over
-- the contact, over 2 pi, as lists by k.
local function each_degree(angle, area, visit)
  local points = gauss_points(cutoff // 2 + 12)
  local cosines, weights, values, before = {}, {}, {}, {}
  for i, point in ipairs(points) do
    cosines[i] = 1 - area / 2 * (1 - point[1] ^ 2)
    weights[i] = area * point[2]
    values[i], before[i] = 1, 0
  end
  for n = 0, math.ceil(cutoff / angle) do
    local radial, tangential = {}, {}
    for k = 0, functions do radial[k], tangential[k] = 0, 0 end
    for i, point in ipairs(points) do
      local x, value, squared = cosines[i], values[i], point[1] ^ 2
      local across, weight = n * (x * value - before[i]), weights[i] -- sin(theta) dP/dtheta
      for k = 0, functions do
        radial[k] = radial[k] - weight * x * value
        tangential[k] = tangential[k] + weight * across
        weight = weight * squared
      end
      before[i], values[i] = value, ((2 * n + 1) * x * value - n * before[i]) / (n + 1)
    end
    visit(n, radial, tangential)
  end
end

-- Work of each pressure (first index) in the displacements by each other one, over 2 pi.
local function works(angle, area)
  local sums = {}
  for j = 0, functions do
    sums[j] = {}
    for k = 0, functions do sums[j][k] = 0 end
  end
  each_degree(angle, area, function(n, radial, tangential)
    for k = 0, functions do
      local factor = (2 * n + 1) / 2
      local u, v = response(n, factor * radial[k],
        n > 0 and factor / (n * (n + 1)) * tangential[k] or 0)
      for j = 0, functions do sums[j][k] = sums[j][k] + u * radial[j] + v * tangential[j] end
    end
  end)
  return sums
end

-- Depth and force when the ball touches the plate up to an angle from the pole. Every pressure does
-- as much work in the displacements as in those of a plane face. That with k = 0, which is infinite
-- at the edge, fixes the depth: none of it is in the solution.
function finite_ball.at_angle(angle)
  local area = 4 * math.sin(angle / 2) ^ 2
  local work = works(angle, area)
  local matrix, right = {}, {}
  for j = 0, functions do
    local row = table.move(work[j], 1, functions, 1, {})
    row[functions + 1] = -integral(j, area)
    matrix[j + 1] = row
    -- The plane face is farther from the pole by 1 - cos(theta) = area / 2 (1 - h^2).
    right[j + 1] = -area / 2 * (integral(j, area) - integral(j + 1, area))
  end
  local found, force = linear.solve(matrix, right), 0
  for k = 1, functions do force = force + 2 * math.pi * integral(k, area) * found[k] end
  return found[functions + 1], force
end

function finite_ball.hertz_force(depth) return 4 / 3 * plane_modulus * depth ^ 1.5 end

-- The force over Hertz's is 1 + s (c1 + c2 ln s + c3 s + c4 s^2) with s = sqrt(depth), to 0.02 %
-- for all depths up to 0.1. The logarithm is that of the displacement near a force on a sphere. The
-- coefficients, from four angles:
local coefficients
do
  local matrix, right = {}, {}
  for i, angle in ipairs{0.1, 0.17, 0.24, 0.3} do
    local depth, force = finite_ball.at_angle(angle)
    local s = math.sqrt(depth)
    matrix[i] = {1, math.log(s), s, s * s}
    right[i] = (force / finite_ball.hertz_force(depth) - 1) / s
  end
  coefficients = linear.solve(matrix, right)
end

function finite_ball.force(depth)
  if depth <= 0 then return 0 end
  local s, c = math.sqrt(depth), coefficients
  return finite_ball.hertz_force(depth)
    * (1 + s * (c[1] + c[2] * math.log(s) + c[3] * s + c[4] * s * s))
end

-- Integral of the force from 0 to the depth.
local function work_to(depth)
  if depth <= 0 then return 0 end
  local s, c = math.sqrt(depth), coefficients
  return 4 / 3 * plane_modulus * s ^ 5 * (2 / 5 + s * (c[1] / 3
    + c[2] / 3 * (math.log(s) - 1 / 6) + c[3] * 2 / 7 * s + c[4] / 4 * s * s))
end

-- Where an increasing function has a value, between 0 and 1.
local function where(increasing, value)
  local low, high = 0, 1
  for _ = 1, 60 do -- to machine precision
    local middle = (low + high) / 2
    if increasing(middle) < value then low = middle else high = middle end
  end
  return high
end

-- The depth at which the force has a value.
function finite_ball.depth(force) return where(finite_ball.force, force) end

-- The largest depth of a ball that hits a plate.
function finite_ball.deepest(speed) return where(work_to, mass * speed ^ 2 / 2) end

local intervals = 1000 -- of the time of contact

-- How long a ball touches a plate that it hits, if its waves are much faster than the impact.
function finite_ball.contact_time(speed)
  local deepest, time = finite_ball.deepest(speed), 0
  local whole = work_to(deepest)
  for i = 1, intervals do
    -- The depth as a sine: the time has no singularity at the turning point.
    local phase = math.pi / 2 * (i - 0.5) / intervals
    local left = whole - work_to(deepest * math.sin(phase))
    time = time + deepest * math.cos(phase) / math.sqrt(2 * left / mass)
  end
  return 2 * time * math.pi / 2 / intervals
end

-- The same for Hertz's force.
function finite_ball.hertz_contact_time(speed)
  return 2.868 * (mass ^ 2 / (plane_modulus ^ 2 * speed)) ^ (1 / 5)
end

return finite_ball
