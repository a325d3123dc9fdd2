-- A study: a stock command whose runs are the units of a sweep. `springlod NAME` plans them, runs
-- them on all cores and reports; `springlod sweep plan NAME` plans them for other machines. Both
-- leave the same files.

local s = require "springlod"
local command = require "lib.command"
local merge = require "sweep.merge"
local run_estimate = require "lib.run_estimate"
local update_rate = require "sweep.update_rate"

local study = {}

-- The stock commands that are studies of this kind.
study.names = {"accuracy", "paper", "pareto", "stability"}

-- Whether the script of a study is only asked for its sweep, which it then returns.
study.planning = false

local Results = {}
Results.__index = Results

-- `stages`: what s.sweep_results gives for each stage, by name. `columns`: of each stage, by name.
local function new_results(stages, columns)
  local results = setmetatable({
    stages = stages, columns_of = columns, by_unit = {}, gaps = {}, units = 0,
  }, Results)
  for name, stage in pairs(stages) do
    local by_unit, found = {}, {}
    for _, row in ipairs(stage.rows) do
      by_unit[row.name] = by_unit[row.name] or {}
      table.insert(by_unit[row.name], row)
    end
    for _, gap in ipairs(stage.gaps) do found[gap.name] = gap.message end
    results.by_unit[name], results.gaps[name] = by_unit, found
    results.units = results.units + #stage.runs + #stage.gaps
  end
  return results
end

-- The rows of a unit; without a result: nil and the reason.
function Results:rows(stage, unit)
  local reason = self.gaps[stage][unit]
  if reason then return nil, reason end
  return self.by_unit[stage][unit] or {}
end

-- As rows; a unit without a result is an error.
function Results:need(stage, unit)
  local rows, reason = self:rows(stage, unit)
  return rows or error(("%s has no result: %s"):format(unit, reason), 0)
end

-- All rows of a stage, and its columns.
function Results:all(stage) return self.stages[stage].rows end
function Results:columns(stage) return self.columns_of[stage] end

-- For titles of charts: " (3 of 120 results are missing)", or nothing.
function Results:note()
  local missing = 0
  for _, gaps in pairs(self.gaps) do
    for _ in pairs(gaps) do missing = missing + 1 end
  end
  return missing == 0 and "" or (" (%d of %d results are missing)"):format(missing, self.units)
end

-- Rows of stages that have ended, for units: earlier(stage, unit) as Results:need.
local function earlier_of(sweep, folder)
  local kept = {}
  return function(stage, unit)
    if not kept[stage] then
      for number, one in ipairs(sweep.stages) do
        if one.name == stage then
          local found = s.sweep_results(sweep, folder, {stage = number})
          kept[stage] = new_results({[stage] = found}, {})
        end
      end
    end
    return kept[stage]:need(stage, unit)
  end
end

-- A stage of s.sweep with named units. `options`: name, columns, timings, waits and alone as for
-- s.sweep; units: list of {name, make, seconds}: make(folder, earlier) returns the rows; `seconds`,
-- or seconds(), is its estimated time on one core. `the_sweep()` returns the sweep.
local function stage_of(options, the_sweep)
  local names, by_name, earlier = {}, {}, nil
  for i, unit in ipairs(options.units) do
    if by_name[unit.name] then error("two units are named " .. unit.name, 0) end
    names[i], by_name[unit.name] = unit.name, unit
  end
  return {
    name = options.name, columns = options.columns, timings = options.timings,
    waits = options.waits, alone = options.alone, axes = {{"name", names}},
    cost = function(point)
      local seconds = by_name[point.name].seconds
      return update_rate() * (type(seconds) == "function" and seconds() or seconds)
    end,
    unit = function(point)
      earlier = earlier or earlier_of(the_sweep(), point.folder)
      local ok, result = command.try(by_name[point.name].make, point.folder, earlier)
      return ok and result or error(result, 0)
    end,
  }
end

-- The sweep of stages (see stage_of; those without units are left out). report(results, folder)
-- writes what is made of the results.
local function sweep_of(stages, report)
  local sweep
  local function the_sweep() return sweep end
  local list, columns = {}, {}
  for _, options in ipairs(stages) do
    columns[options.name] = options.columns
    if #options.units > 0 then list[#list + 1] = stage_of(options, the_sweep) end
  end
  sweep = s.sweep{stages = list, report = function(results, folder)
    report(new_results(results.stages, columns), folder)
  end}
  return sweep
end

-- Plans, runs and reports in args.out.
local function perform(args, options)
  local sweep = sweep_of(options.describe(), options.report)
  local plan = s.plan_sweep(sweep, args.out, {
    script = command.script(), arguments = command.words_without_out(args),
    seconds_per_cost = 1 / update_rate(),
  })
  run_estimate.announce("all of it", plan.seconds, options.hint)
  s.run_sweep(args.out)
  merge(sweep, args.out)
  if not options.keep then s.remove_sweep(args.out) end
end

-- The end of the script of a study. `args`: of the command line. `options`:
--   describe(): returns the stages;
--   report(results, folder): writes tables and charts;
--   keep: whether results stay, so that the same command does not compute them again;
--   hint: how to make it shorter, for the announcement;
--   failure: the beginning of messages (default: the name of the command).
function study.run(args, options)
  if study.planning then return sweep_of(options.describe(), options.report) end
  local ok, reason = command.try_in(args.out, function() perform(args, options) end, true)
  if not ok then command.fail("%s: %s", options.failure or command.name(), reason) end
  s.say("wrote " .. args.out)
end

return study
