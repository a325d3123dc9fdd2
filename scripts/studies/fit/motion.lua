-- Smooth velocity fields, means over groups, and displacements without their rigid motion.

local cross = require("lib.vectors").cross

local motion = {}

-- A smooth random field: `waves` waves of random direction and phase with at most half a wave
-- across the body. Returns a function of a Node.
function motion.smooth_field(bounds, seed, waves)
  math.randomseed(seed)
  local function random() return 2 * math.random() - 1 end
  local list = {}
  for i = 1, waves do
    list[i] = {
      amplitude = {random(), random(), random()}, phase = math.pi * random(),
      vector = {random(), random(), random()},
    }
  end
  local size = bounds.diagonal
  return function(node)
    local v = {0, 0, 0}
    for _, wave in ipairs(list) do
      local along = wave.vector[1] * node.x + wave.vector[2] * node.y + wave.vector[3] * node.z
      local value = math.sin(math.pi * along / size + wave.phase)
      for d = 1, 3 do v[d] = v[d] + value * wave.amplitude[d] end
    end
    return v
  end
end

-- Sums of a field, weighted by the mass of each node, over groups: `map` is that of chain:group_map
-- and `count` the number of groups.
function motion.momenta(nodes, field, map, count)
  local sums = {}
  for g = 1, count do sums[g] = {0, 0, 0} end
  for i, node in ipairs(nodes) do
    local sum, value = sums[map[i]], field[i]
    for d = 1, 3 do sum[d] = sum[d] + node.mass * value[d] end
  end
  return sums
end

-- Vectors divided by the numbers of `divisors`.
function motion.divided(vectors, divisors)
  local list = {}
  for i, v in ipairs(vectors) do
    list[i] = {v[1] / divisors[i], v[2] / divisors[i], v[3] / divisors[i]}
  end
  return list
end

-- Solves m x = b for a symmetric 3 x 3 matrix by its adjugate. A body without inertia about an axis
-- has no solution: no rotation then.
local function solve3(m, b)
  local columns = {cross(m[2], m[3]), cross(m[3], m[1]), cross(m[1], m[2])}
  local determinant = m[1][1] * columns[1][1] + m[1][2] * columns[1][2] + m[1][3] * columns[1][3]
  if determinant == 0 then return {0, 0, 0} end
  local x = {0, 0, 0}
  for d = 1, 3 do
    x[d] = (columns[1][d] * b[1] + columns[2][d] * b[2] + columns[3][d] * b[3]) / determinant
  end
  return x
end

-- `field` without the rigid motion (translation and small rotation) that has its momentum and
-- angular momentum. `places`: {x, y, z} of each node.
function motion.without_rigid(places, masses, field)
  local mass, center, mean = 0, {0, 0, 0}, {0, 0, 0}
  for i, m in ipairs(masses) do
    mass = mass + m
    for d = 1, 3 do
      center[d], mean[d] = center[d] + m * places[i][d], mean[d] + m * field[i][d]
    end
  end
  for d = 1, 3 do center[d], mean[d] = center[d] / mass, mean[d] / mass end
  local angular, inertia = {0, 0, 0}, {{0, 0, 0}, {0, 0, 0}, {0, 0, 0}}
  local arms = {}
  for i, m in ipairs(masses) do
    local r = {places[i][1] - center[1], places[i][2] - center[2], places[i][3] - center[3]}
    local spin = cross(r, field[i])
    local square = r[1] ^ 2 + r[2] ^ 2 + r[3] ^ 2
    for d = 1, 3 do
      angular[d] = angular[d] + m * spin[d]
      for e = 1, 3 do
        inertia[d][e] = inertia[d][e] + m * ((d == e and square or 0) - r[d] * r[e])
      end
    end
    arms[i] = r
  end
  local turn, rest = solve3(inertia, angular), {}
  for i, v in ipairs(field) do
    local rotation = cross(turn, arms[i])
    rest[i] = {v[1] - mean[1] - rotation[1], v[2] - mean[2] - rotation[2],
               v[3] - mean[3] - rotation[3]}
  end
  return rest
end

-- Sums of masses times squares: of the difference of two fields, and of the second.
function motion.squares(masses, field, reference)
  local difference, size = 0, 0
  for i, m in ipairs(masses) do
    for d = 1, 3 do
      difference = difference + m * (field[i][d] - reference[i][d]) ^ 2
      size = size + m * reference[i][d] ^ 2
    end
  end
  return difference, size
end

return motion
