-- Wall-clock cost of a simulated second, relative to that of the base measured alternately.

local s = require "springlod"
local cut_scene = require "lib.cut_scene"
local intervals = require "lib.intervals"
local pareto_chains = require "studies.pareto.chains"
local timed_run = require "lib.timed_run"

local pareto_times = {}

-- Wall-clock time of a timed run of the base [s]: long compared with the clock's resolution and
-- other activity of the machine. Shorter runs are repeated to fill at least half of it.
local base_seconds = 0.1
local least_seconds = base_seconds / 2
local usual_rate = 2e8 -- spring updates a second of one core, about
local patience = 5 -- for the repeats of one variant [s]; afterwards least_repeats are enough
local least_repeats = 3

local columns = {"method_seed", "base_seconds", "seconds", "ratio", "spring_updates", "step"}

-- The scene up to a time that does not depend on the machine.
local function timed_scene(study)
  local springs = study.base.spring_count
  local duration = base_seconds * usual_rate * s.stable_step(study.base) / springs
  return s.scenario(cut_scene(study.scene, math.min(study.scenario.duration, duration)))
end

-- Runs the base and the variant alternately, cycling through the seeds, from the unjittered start.
local function timed_rows(study, scene, variant, folder, earlier)
  local found, begun = {}, os.time()
  local seeds = pareto_chains.count(study, variant.making)
  for turn = 1, study.settings.repeats do
    local seed = (turn - 1) % seeds + 1
    local of_base = timed_run.long(study.base, scene, {}, least_seconds)
    local level = pareto_chains.level(study, folder, variant, seed, earlier)
    local seconds, updates, step = timed_run.long(level, scene, variant.step_options,
      least_seconds)
    found[turn] = {method_seed = seed, base_seconds = of_base, seconds = seconds,
                   ratio = seconds / of_base, spring_updates = updates, step = step}
    if turn >= least_repeats and os.difftime(os.time(), begun) > patience then break end
  end
  return found
end

-- The stage of all timed runs. `study`: base, scene, scenario, settings (repeats).
function pareto_times.stage(study, variants)
  local units, scene = {}, nil
  for i, variant in ipairs(variants) do
    units[i] = {
      name = variant.name, seconds = 2 * base_seconds * study.settings.repeats,
      make = function(folder, earlier)
        scene = scene or timed_scene(study)
        return timed_rows(study, scene, variant, folder, earlier)
      end,
    }
  end
  return {name = "times", columns = columns, timings = columns, units = units, alone = true}
end

local Times = {}
Times.__index = Times

function pareto_times.read(results)
  return setmetatable({results = results, base_costs = {}}, Times)
end

-- Medians with intervals over the repeats; nil and the reason if there are none.
function Times:cost_of(variant)
  local rows, reason = self.results:rows("times", variant.name)
  if not rows then return nil, reason end
  local values = {}
  for _, name in ipairs(columns) do
    values[name] = {}
    for i, row in ipairs(rows) do values[name][i] = row[name] end
  end
  table.move(values.base_seconds, 1, #rows, #self.base_costs + 1, self.base_costs)
  return {ratio = intervals.median(values.ratio), seconds = intervals.median(values.seconds),
          spring_updates = s.mean(values.spring_updates), step = rows[1].step,
          repeats = #rows}
end

-- Cost of the base over all timed runs so far [wall-clock s per simulated s].
function Times:base_cost() return intervals.median(self.base_costs).value end

return pareto_times
