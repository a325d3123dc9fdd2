-- Wall-clock cost of a simulated second.

local s = require "springlod"

local timed_run = {}

-- One run on one thread without output. Returns, per simulated second, the wall-clock time (without
-- the one-time planning) and the number of spring updates; then the time step [s].
function timed_run.once(model, scene, more)
  local options = {threads = 1, frame_rate = 0, ledger = false, sleep = 0, quiet = true}
  for key, value in pairs(more or {}) do options[key] = value end
  local run = s.run(model, scene, options)
  local seconds = run.wall_seconds - run.planning_seconds
  return seconds / run.simulated, run.spring_updates / run.simulated, run.step
end

-- The mean over enough runs to last at least `least` seconds.
function timed_run.long(model, scene, more, least)
  local seconds, count, spent = 0, 0, 0
  local updates, step
  repeat
    local one
    one, updates, step = timed_run.once(model, scene, more)
    seconds, count, spent = seconds + one, count + 1, spent + one * scene.duration
  until spent >= least
  return seconds / count, updates, step
end

return timed_run
