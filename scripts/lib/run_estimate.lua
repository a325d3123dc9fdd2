-- Estimates of how long a study takes, from short runs of its models.

local s = require "springlod"
local cut_scene = require "lib.cut_scene"
local timed_run = require "lib.timed_run"

local run_estimate = {}

local explicit_steps, implicit_steps = 20, 2 -- of a short run: implicit ones take far longer
local least = 0.02 -- its shortest total processor time [s]

-- Processor time of a simulated second. `scene`: a table for s.scenario. `options`: those of s.run;
-- without a step, the stable step. nil if the integrator cannot run the model.
function run_estimate.of(model, scene, options)
  local step = options.step or s.stable_step(model)
  local steps = s.choices.integrator[options.integrator or "symplectic_euler"].implicit
    and implicit_steps or explicit_steps
  local ok, seconds = pcall(timed_run.processor, model, cut_scene(scene, steps * step), options,
    least)
  return ok and math.max(0, seconds) or nil
end

local shortest = 5 -- that is worth an announcement [s]

-- "20 s", "3 minutes", "2.5 hours".
local function text_of(seconds)
  if seconds < 90 then return ("%.0f s"):format(seconds) end
  if seconds < 90 * 60 then return ("%.0f minutes"):format(seconds / 60) end
  return ("%.1f hours"):format(seconds / 3600)
end

-- Says how long `what` takes, if that is long. `seconds`: of processor time; `hint`: how to make it
-- shorter.
function run_estimate.announce(what, seconds, hint)
  if seconds < shortest then return end
  s.say(("%s takes about %s of processor time, shared by the cores (%s)"):format(what,
    text_of(seconds), hint))
end

return run_estimate
