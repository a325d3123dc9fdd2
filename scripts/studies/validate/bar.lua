local s = require "springlod"
local bodies = require "studies.validate.bodies"

-- The more slender, the less the motion across the axis takes: 1.9 % of the speed at 20 m, 1.1 % at
-- 40 m and 0.7 % at 80 m.
local length, speed = 80, 0.1 -- [m], [m/s]
local gap = 0.02 * length -- to the wall, which nothing touches at first
local there_and_back = 2 * length / bodies.bar_speed -- of a wave [s]
local frames = 2000 -- while the wave travels
-- Energy of the contacts over the whole energy from which on the bar counts as touching [1].
local touching = 1e-6
-- Frequencies that the levels are fitted to. The wave consists of the modes that stretch the bar:
-- one is among the 20 lowest, to which a fit is made by default, and five are among the 60 lowest.
local fitted_modes = 60

return {
  name = "bar",
  title = "Bar against a wall",
  text = "A bar, 80 times as long as high, flies against a wall along its axis. A wave runs to its "
    .. "free end and back; then the bar leaves with the speed that it had. Levels are fitted to "
    .. fitted_modes .. " modes instead of 20.",
  source = "Saint-Venant 1867: contact lasts 2 L / c with c = sqrt(E / rho). The theory of a thin "
    .. "bar has no motion across the axis, which keeps some of the energy of a real bar.",
  notes = [[
The wave consists of the modes that stretch the bar. The default of 20 modes has one of these, as
nearly all low modes of a slender bar bend it; 60 modes have five. With the default, the others are
too low in a level, mixed with bending and twisting: the wave comes back late, its front is less
steep, and contact lasts too long.
]],
  size_name = "cells across", sizes = {2, 3, 4}, quick = {2}, fitted = true,
  fitted_modes = fitted_modes,
  quantities = {
    {name = "contact time c / 2 L", reference = 1, goal = 1, level_goals = {2, 3}},
    {name = "speed after / before", reference = 1, goal = 1, level_goals = {2, 3}},
  },
  body = function(cells) return bodies.box({length, 1, 1}, cells) end,
  measure = function(model)
    local run = s.run(model, {
      gravity = {0, 0, 0}, duration = gap / speed + 1.5 * there_and_back,
      throw = {velocity = {-speed, 0, 0}},
      obstacles = {{plane = {1, 0, 0, -gap}, friction = 0, name = "wall"}},
    }, {frame_rate = frames / there_and_back, contact = "surface", quiet = true})
    local contact_time = bodies.contact_time(run, touching)
    return {contact_time and contact_time / there_and_back or false,
            bodies.velocity(model, run.final)[1] / speed}
  end,
}
