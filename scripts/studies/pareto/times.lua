-- Wall-clock cost of a simulated second, relative to that of the base measured alternately.

local s = require "springlod"
local cut_scene = require "lib.cut_scene"
local intervals = require "lib.intervals"
local timed_run = require "lib.timed_run"

local pareto_times = {}

local Times = {}
Times.__index = Times

-- Wall-clock time of a timed run of the base [s]: long compared with the clock's resolution and
-- other activity of the machine. Shorter runs are repeated to fill at least half of it.
local base_seconds = 0.1
local least_seconds = base_seconds / 2
local patience = 5 -- for the repeats of one variant [s]; afterwards least_repeats are enough
local least_repeats = 3

local columns = {"seed", "base_seconds", "seconds", "ratio", "spring_updates", "step"}

-- `study`: base, scene, scenario, settings (repeats), store.
function pareto_times.new(study)
  local rows = study.store:rows("timed", {"duration"}, function()
    local cost = timed_run.once(study.base, cut_scene(study.scene, study.scenario.duration), {})
    return {{duration = math.min(study.scenario.duration, base_seconds / cost)}}
  end)
  return setmetatable({
    study = study, scene = s.scenario(cut_scene(study.scene, rows[1].duration)), base_costs = {},
  }, Times)
end

-- Runs the base and the variant alternately, cycling through the seeds, from the unjittered start.
-- Returns medians with intervals over the repeats.
function Times:cost_of(variant, chains)
  local study = self.study
  local rows = study.store:rows("times/" .. variant.name, columns, function()
    local found, begun = {}, os.time()
    for turn = 1, study.settings.repeats do
      local seed = (turn - 1) % #chains + 1
      local of_base = timed_run.long(study.base, self.scene, {}, least_seconds)
      local seconds, updates, step = timed_run.long(chains[seed][variant.level], self.scene,
        variant.step_options, least_seconds)
      found[turn] = {seed = seed, base_seconds = of_base, seconds = seconds,
                     ratio = seconds / of_base, spring_updates = updates, step = step}
      if turn >= least_repeats and os.difftime(os.time(), begun) > patience then break end
    end
    return found
  end)
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
