local s = require "springlod"
local bodies = require "studies.validate.bodies"

local friction, speed, duration = 0.3, 4, 0.8 -- [1], [m/s], [s]
local gravity = 9.81 -- [m/s2]

return {
  name = "sliding",
  title = "Sliding block",
  text = "A block of 2 m x 1 m x 1 m slides on a floor; mean deceleration, from its displacement.",
  source = "Coulomb: mu g.",
  size_name = "cells across", sizes = {2, 4, 8}, quick = {2, 3}, fitted = true,
  quantities = {{name = "deceleration / g", reference = friction, goal = 1}},
  body = function(cells) return bodies.box({2, 1, 1}, cells) end,
  measure = function(model)
    local run = s.run(model, {
      gravity = {0, 0, -gravity}, duration = duration, throw = {velocity = {speed, 0, 0}},
      obstacles = {{plane = {0, 0, 1, 0}, friction = friction}},
    }, {frame_rate = 0, contact = "surface", quiet = true})
    local moved = bodies.position(model, run.final)[1] - bodies.position(model, run:frame(1))[1]
    return {2 * (speed * duration - moved) / duration ^ 2 / gravity}
  end,
}
