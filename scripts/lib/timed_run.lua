-- Wall-clock or processor cost of a simulated second.

local s = require "springlod"
local cut_scene = require "lib.cut_scene"

local timed_run = {}

-- The options with those of `more`.
local function with(options, more)
  local all = {}
  for key, value in pairs(options) do all[key] = value end
  for key, value in pairs(more) do all[key] = value end
  return all
end

-- A run on one thread without output, to its end.
local function run_of(model, scene, more)
  local silent = {threads = 1, frame_rate = 0, ledger = false, sleep = 0, quiet = true}
  return s.run(model, scene, with(silent, more or {}))
end

-- One run. Returns, per simulated second, the wall-clock time (without the one-time planning) and
-- the number of spring updates; then the time step [s].
function timed_run.once(model, scene, more)
  local run = run_of(model, scene, more)
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

-- By processor time, which other work on the machine changes less, and without what a run does
-- once: the time of a run of a single step is subtracted. `scene`: a table for s.scenario without a
-- rest criterion. Returns the first two results of timed_run.once.
function timed_run.processor(model, scene, more, least)
  local seconds, count = 0, 0
  local run
  repeat
    run = run_of(model, scene, more)
    seconds, count = seconds + run.processor_seconds, count + 1
  until seconds >= least
  local single = run_of(model, cut_scene(scene, run.step), with(more or {}, {step = run.step}))
  local simulated = run.simulated - single.simulated
  return (seconds / count - single.processor_seconds) / simulated,
    (run.spring_updates - single.spring_updates) / simulated
end

return timed_run
