-- Writes the results of a sweep as tables into its folder, and what its script makes of them.

local s = require "springlod"
local command = require "lib.command"
local show = require "lib.show"

-- Axes and columns of a stage, in the order of its tables.
local function columns_of(stage, after)
  local columns = {"unit"}
  for _, list in ipairs{stage.axes, after} do
    table.move(list, 1, #list, #columns + 1, columns)
  end
  return columns
end

-- Rows for the units that have none, with their axes; `missing` says why there is no result. Units
-- that have returned no row have one without values.
local function rows_of_others(sweep, stage, results)
  local has_rows, others = {}, {}
  local function add(unit, point, missing)
    local row = {unit = unit, missing = missing}
    for _, axis in ipairs(stage.axes) do row[axis] = point[axis] end
    others[#others + 1] = row
  end
  for _, row in ipairs(results.rows) do has_rows[row.unit] = true end
  for _, run in ipairs(results.runs) do
    if not has_rows[run.unit] then add(run.unit, sweep:point(run.unit)) end
  end
  for _, gap in ipairs(results.gaps) do
    add(gap.unit, gap, ("%s: %s"):format(gap.state, gap.message))
  end
  table.sort(others, function(a, b) return a.unit < b.unit end)
  return others
end

-- The rows of a stage by unit: each unit has at least one.
local function with_others(sweep, stage, results)
  local all, others, next_other = {}, rows_of_others(sweep, stage, results), 1
  local function add_others(before)
    while others[next_other] and others[next_other].unit < before do
      all[#all + 1] = others[next_other]
      next_other = next_other + 1
    end
  end
  for _, row in ipairs(results.rows) do
    add_others(row.unit)
    all[#all + 1] = row
  end
  add_others(math.huge)
  return all
end

-- The columns that are no measured times: they are the same whenever the unit runs.
local function same_columns(stage)
  local timed, same = {}, {}
  for _, name in ipairs(stage.timings) do timed[name] = true end
  for _, name in ipairs(stage.columns) do
    if not timed[name] then same[#same + 1] = name end
  end
  return same
end

-- `suffix`: of the names of the files.
local function write_stage(folder, sweep, stage, results, suffix)
  local function write(name, rows, columns)
    s.csv(("%s/%s%s.csv"):format(folder, name, suffix), rows, {columns = columns})
  end
  local columns = columns_of(stage, same_columns(stage))
  columns[#columns + 1] = "missing"
  write("results", with_others(sweep, stage, results), columns)
  if #stage.timings > 0 then
    write("timings", results.rows, columns_of(stage, stage.timings))
  end
  write("gaps", results.gaps, columns_of(stage, {"state", "message", "host", "signal", "log"}))
  write("runs", results.runs,
    {"unit", "seconds", "memory", "host", "target", "blas", "springlod"})
end

-- What results depend on that the processor chooses: what a run has of it, and what differs then.
local mixtures = {
  {of = function(run) return run.blas end,
   text = "for which OpenBLAS chose different kernels (%s): fits and modes differ"},
  {of = function(run) return run.target:find("^AVX") and "AVX2 or newer" or "older" end,
   text = "with vector instructions that round differently (%s): all runs differ"},
}

-- Says if units ran on processors whose results differ. `runs`: of all stages.
local function say_mixtures(runs)
  for _, mixture in ipairs(mixtures) do
    local counts, kinds = {}, {}
    for _, run in ipairs(runs) do
      local kind = mixture.of(run)
      counts[kind] = (counts[kind] or 0) + 1
    end
    for kind, count in pairs(counts) do kinds[#kinds + 1] = ("%s: %d"):format(kind, count) end
    table.sort(kinds)
    if #kinds > 1 then
      s.say(("units ran on different processors, " .. mixture.text .. " in their last digits; plan "
        .. "with --portable to avoid this"):format(table.concat(kinds, ", ")))
    end
  end
end

local function say_gaps(gaps, suffix)
  if #gaps == 0 then return end
  s.say(("%s without a result, see gaps%s.csv; the first is unit %d: %s"):format(
    show.count(#gaps, "unit"), suffix, gaps[1].unit, gaps[1].message))
end

return function(sweep, folder)
  local last, by_name, runs = nil, {}, {}
  for number, stage in ipairs(sweep.stages) do
    last = s.sweep_results(sweep, folder, {stage = number})
    by_name[stage.name] = last
    local suffix = #sweep.stages > 1 and "-" .. stage.name:gsub("%W+", "-") or ""
    write_stage(folder, sweep, stage, last, suffix)
    say_gaps(last.gaps, suffix)
    table.move(last.runs, 1, #last.runs, #runs + 1, runs)
  end
  if not s.portable then say_mixtures(runs) end
  last.stages = by_name
  if not sweep.report then return end
  local ok, reason = command.try(sweep.report, last, folder)
  if not ok then error(("report fails: %s; the tables are written"):format(reason), 0) end
end
