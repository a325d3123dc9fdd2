local s = require "springlod"
local bodies = require "studies.validate.bodies"
local finite_ball = require "studies.validate.finite_ball"
local markdown = require "lib.markdown"

local relative_speed = 0.007 -- over that of waves in a bar: sinks in by 3 % of the radius
local speed = relative_speed * bodies.bar_speed -- [m/s]
local unit = bodies.radius / bodies.bar_speed -- of time [s]
local known = finite_ball.contact_time(relative_speed) * unit -- [s]
local gap = 0.01 * bodies.radius -- to the plate, which nothing touches at first [m]
local frames = 1000 -- in the known time
-- Energy of the contacts over the whole energy from which on the ball counts as touching [1].
local touching = 1e-9

local function table_of_factors()
  local rows = {}
  for i, each in ipairs{0.0005, 0.002, 0.004, relative_speed, 0.014, 0.03} do
    rows[i] = {("%g"):format(each), ("%.4f"):format(finite_ball.deepest(each)),
      ("%.3f"):format(finite_ball.contact_time(each) / finite_ball.hertz_contact_time(each))}
  end
  return markdown.table(rows, {"speed / sqrt(E / rho)", "largest depth over radius",
                               "time over that of Hertz"})
end

return {
  name = "bounce",
  title = "Ball against a plate",
  text = ("A ball flies against a plate with %g of the speed of waves in a bar, sqrt(E / rho), "
    .. "without friction and gravity. The base has cut cells: its surface is that of the "
    .. "mesh."):format(relative_speed),
  source = ("The force of the problem before, if the impact is much slower than the vibrations of "
    .. "the ball; then the ball also leaves with the speed that it had. The time of Hertz 1882, "
    .. "2.87 (m^2 / (R E*^2 v))^(1/5), is that of a half space near the contact; the time of the "
    .. "ball is %.3f times as long at this speed."):format(
      finite_ball.contact_time(relative_speed) / finite_ball.hertz_contact_time(relative_speed)),
  notes = table_of_factors() .. "\n",
  size_name = "cells across", sizes = {12, 16, 24}, quick = {6, 8}, fitted = true,
  quantities = {
    {name = "contact time / reference", reference = 1, goal = 3, level_goals = {5, 8}},
    {name = "speed after / before", reference = 1, goal = 3, level_goals = {5, 8}},
  },
  body = bodies.cut_ball,
  measure = function(model)
    local run = s.run(model, {
      gravity = {0, 0, 0}, duration = gap / speed + 1.5 * known,
      throw = {velocity = {0, 0, -speed}},
      obstacles = {{plane = {0, 0, 1, -bodies.radius - gap}, friction = 0, name = "plate"}},
    }, {frame_rate = frames / known, safety = 0.4, contact = "surface", quiet = true})
    local contact_time = bodies.contact_time(run, touching)
    return {contact_time and contact_time / known or false,
            bodies.velocity(model, run.final)[3] / speed}
  end,
}
