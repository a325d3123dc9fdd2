local s = require "springlod"
local bodies = require "studies.validate.bodies"
local vectors = require "lib.vectors"

local spin, velocity, duration = {3, 5, 7}, {1, 2, 3}, 2 -- [rad/s], [m/s], [s]

-- Angular momentum about the centre of mass, of positions x and velocities v [kg m2/s].
local function angular_momentum(model, state)
  local center, mean = bodies.position(model, state), bodies.velocity(model, state)
  local sum = {0, 0, 0}
  for i, node in ipairs(model:nodes()) do
    local of_node = vectors.cross(vectors.minus(state.x[i], center),
      vectors.minus(state.v[i], mean))
    for d = 1, 3 do sum[d] = sum[d] + node.mass * of_node[d] end
  end
  return sum
end

-- The state in which the run begins.
local function thrown(model)
  local state = {x = {}, v = {}}
  for i, node in ipairs(model:nodes()) do state.x[i] = {node.x, node.y, node.z} end
  local center = bodies.position(model, state)
  for i, x in ipairs(state.x) do
    local turning = vectors.cross(spin, vectors.minus(x, center))
    state.v[i] = {velocity[1] + turning[1], velocity[2] + turning[2], velocity[3] + turning[3]}
  end
  return state
end

local function relative_change(now, before)
  local difference, size = 0, 0
  for d = 1, 3 do
    difference, size = difference + (now[d] - before[d]) ^ 2, size + before[d] ^ 2
  end
  return math.sqrt(difference / size)
end

return {
  name = "spin",
  title = "Free body that spins",
  text = "A block of 2 m x 1 m x 1 m spins freely about a skew axis for "
    .. ("%g s: momentum and angular momentum at the end, relative change."):format(duration),
  source = "Both are conserved.",
  size_name = "cells across", sizes = {2, 4, 8}, quick = {2, 3}, fitted = true,
  quantities = {
    {name = "change of momentum", reference = 0, goal = 1e-12, level_goals = {1e-12, 1e-12}},
    {name = "change of angular momentum", reference = 0, goal = 1e-12,
     level_goals = {1e-12, 1e-12}},
  },
  body = function(cells) return bodies.box({2, 1, 1}, cells) end,
  measure = function(model)
    local run = s.run(model, {gravity = {0, 0, 0}, duration = duration,
                              throw = {velocity = velocity, spin = spin}},
      {frame_rate = 0, quiet = true})
    local before, after = thrown(model), run.final
    return {relative_change(bodies.velocity(model, after), bodies.velocity(model, before)),
            relative_change(angular_momentum(model, after), angular_momentum(model, before))}
  end,
}
