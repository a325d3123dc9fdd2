local s = require "springlod"
local bodies = require "studies.validate.bodies"
local finite_ball = require "studies.validate.finite_ball"
local markdown = require "lib.markdown"

local pressed = 0.03 -- depth over the radius at which the ball should rest
local unit = bodies.material.young * bodies.radius ^ 2 -- of force [N]
local weight = finite_ball.force(pressed) * unit -- [N]
-- After so many runs, the base is at rest to 0.01 %. A level is less round: in many more, it would
-- roll to where its centre of mass is lower.
local runs = 8

-- The depth of the ball at rest, over its radius, by kinetic damping: each run ends when the ball,
-- if it were a mass on a spring, would pass its height of rest, and the next one starts from there
-- without velocity.
local function depth_at_rest(model)
  local gravity = weight / model.mass
  local quarter = math.pi / 2 * math.sqrt(pressed * bodies.radius / (1.5 * gravity)) -- period [s]
  local state
  for number = 1, runs do
    local run = s.run(model, {
      gravity = {0, 0, -gravity},
      -- Two times, so that no vibration has a whole number of periods in both.
      duration = number % 2 == 0 and quarter or 0.7 * quarter,
      obstacles = {{plane = {0, 0, 1, -bodies.radius}, friction = 0, name = "plate"}},
    }, {start = state, contact = "surface", frame_rate = 0, ledger = false, quiet = true})
    state = {x = run.final.x}
  end
  -- Its centre of mass was at the origin when the ball touched the plate without force.
  return -bodies.position(model, state)[3] / bodies.radius
end

local function table_of_factors()
  local rows = {}
  for i, depth in ipairs{0.001, 0.01, 0.02, 0.03, 0.05, 0.1} do
    rows[i] = {("%g"):format(depth),
      ("%.3f"):format(finite_ball.force(depth) / finite_ball.hertz_force(depth))}
  end
  return markdown.table(rows, {"depth over radius", "force over that of Hertz"})
end

local notes = [[
The series is for small strains. Here they are about 10 % at the contact, where materials of the
same elastic constants differ. At this depth, axisymmetric finite elements at large strain
(CalculiX 2.20, `tests/peers/calculix.lua`) need 3 % less force than the series for a neo-Hookean
material, and 11 % less for a Saint Venant-Kirchhoff material. At small strain, they have the depth
of the series to 0.01 %.

The radius of contact, sqrt(R d) = 0.17 R, spans 2.1 cells of the base at 24 cells across, but only
1.6 and 1.2 distances of nodes of the levels. How stiff these are at one place depends on where
their groups lie: to resolve a contact, give a level two nodes across its radius.

]]

return {
  name = "hertz",
  title = "Ball on a plate",
  text = ("A ball rests on a plate without friction. Its weight is such that its centre of mass "
    .. "should sink by %g %% of its radius. The quantity is the weight over the force that a ball "
    .. "needs for the depth that was found. The base has cut cells: its surface is that of the "
    .. "mesh."):format(100 * pressed),
  source = ("Elastic sphere pressed by a plate and balanced by a uniform body force, as a series "
    .. "of Legendre polynomials (Lur'e 1964); `scripts/studies/validate/finite_ball.lua` has the "
    .. "details. The force of Hertz 1882, 4/3 E* sqrt(R) d^1.5, is that of a half space near the "
    .. "contact; the force of the ball is %.3f times as large at this depth."):format(
      finite_ball.force(pressed) / finite_ball.hertz_force(pressed)),
  notes = notes .. table_of_factors() .. "\n",
  size_name = "cells across", sizes = {12, 16, 24}, quick = {6, 8}, fitted = true,
  quantities = {{name = "weight / force at this depth", reference = 1, goal = 3,
                 level_goals = {5, 8}}},
  body = bodies.cut_ball,
  measure = function(model)
    return {weight / unit / finite_ball.force(depth_at_rest(model))}
  end,
}
