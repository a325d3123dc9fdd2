-- The tables and the chart of the throws, from the rows of studies/throws/measure.lua.

local s = require "springlod"
local command = require "lib.command"
local lists = require "lib.lists"
local markdown = require "lib.markdown"

local summary = {}

local much = 0.01 -- ledger or scheme error from which a run counts as inaccurate
local worst_count = 5 -- entries in each list of the worst runs

-- The columns of throws.csv: those of a run, then the parameters of its throw.
local run_columns = {
  "level", "nodes", "springs", "corners", "inverted_at_end", "most_inverted", "first_inversion",
  "ledger_error", "scheme_error", "volume_ratio", "simulated", "steps", "step", "shortest_step",
  "spring_updates", "error", "message",
}
local throw_columns = {
  "shape", "cells", "cell", "base", "layout", "young", "ratio", "grouping", "fitted", "contact",
  "integrator", "precision", "stiffness", "friction", "wall", "speed", "wave_speed", "spin",
}

summary.columns = lists.joined({"throw"}, run_columns, throw_columns)

-- Rows for s.csv with these columns.
function summary.cells(rows)
  local list = {}
  for i, row in ipairs(rows) do
    list[i] = {throw = row.throw.number}
    for _, column in ipairs(run_columns) do list[i][column] = row[column] end
    for _, column in ipairs(throw_columns) do
      local value = row.throw[column]
      list[i][column] = type(value) == "boolean" and (value and "yes" or "no") or value
    end
  end
  return list
end

-- The parameters of a throw in one line.
function summary.description(throw)
  return ("%s of %d cells of %.3g cm, %s; %s, E %.3g MPa, ratio %.3g; %s%s; contact at %s, "
    .. "stiffness %s, friction %.2f%s; %s, %s; %.3g m/s (%.2f of the wave speed), spin %.3g rad/s")
    :format(throw.shape, throw.cells or 0, 100 * throw.cell, throw.base, throw.layout,
      throw.young / 1e6, throw.ratio, throw.grouping, throw.fitted and ", fitted" or "",
      throw.contact,
      type(throw.stiffness) == "number" and ("%.2g"):format(throw.stiffness) or throw.stiffness,
      throw.friction, throw.wall and ", wall" or "", throw.integrator, throw.precision,
      throw.speed, throw.speed / throw.wave_speed, throw.spin)
end

local function at_end(row) return not row.error and row.inverted_at_end > 0 end
local function on_the_way(row) return not row.error and row.most_inverted > 0 end
local function inaccurate(row) return not row.error and row.ledger_error > much end
local function coarse(row) return not row.error and row.scheme_error > much end
local function failed(row) return row.error ~= nil end

local function count(rows, accepts)
  local number = 0
  for _, row in ipairs(rows) do
    if accepts(row) then number = number + 1 end
  end
  return number
end

-- Ledger errors of the completed runs, ascending.
local function ledger_errors(rows)
  local list = {}
  for _, row in ipairs(rows) do
    if not row.error then list[#list + 1] = row.ledger_error end
  end
  table.sort(list)
  return list
end

local count_columns = {
  "level", "runs", "failed", "inverted at end", "inverted on the way", "ledger error > 1 %",
  "median ledger error [%]", "largest [%]", "scheme error > 1 %",
}

local function count_row(name, rows)
  local errors = ledger_errors(rows)
  local function percent(value) return value and ("%.2g"):format(100 * value) or "" end
  return {
    name, #rows, count(rows, failed), count(rows, at_end), count(rows, on_the_way),
    count(rows, inaccurate), percent(errors[(#errors + 1) // 2]), percent(errors[#errors]),
    count(rows, coarse),
  }
end

local function counts(rows)
  local of_level, list, coarsest = {}, {}, 0
  for _, row in ipairs(rows) do
    if row.level then
      of_level[row.level] = of_level[row.level] or {}
      table.insert(of_level[row.level], row)
      coarsest = math.max(coarsest, row.level)
    end
  end
  for level = 0, coarsest do
    if of_level[level] then list[#list + 1] = count_row(level, of_level[level]) end
  end
  list[#list + 1] = count_row("all", rows)
  return list
end

-- The accepted rows, those with the largest value first, at most worst_count.
local function worst(rows, accepts, value)
  local list = {}
  for _, row in ipairs(rows) do
    if accepts(row) then list[#list + 1] = row end
  end
  table.sort(list, function(a, b)
    local of_a, of_b = value(a), value(b)
    if of_a ~= of_b then return of_a > of_b end
    if a.throw ~= b.throw then return a.throw.number < b.throw.number end
    return a.level < b.level
  end)
  return table.move(list, 1, math.min(worst_count, #list), 1, {})
end

local function of_corners(number, row) return ("%d of %d corners"):format(number, row.corners) end

local worst_kinds = {
  {name = "inverted at end", accepts = at_end,
   value = function(row) return row.inverted_at_end / row.corners end,
   text = function(row) return of_corners(row.inverted_at_end, row) end},
  {name = "inverted on the way", accepts = on_the_way,
   value = function(row) return row.most_inverted / row.corners end,
   text = function(row)
     return ("%s, first at %.4g s"):format(of_corners(row.most_inverted, row), row.first_inversion)
   end},
  {name = "ledger error > 1 %", accepts = inaccurate,
   value = function(row) return row.ledger_error end,
   text = function(row) return ("%.3g %%"):format(100 * row.ledger_error) end},
  {name = "scheme error > 1 %", accepts = coarse,
   value = function(row) return row.scheme_error end,
   text = function(row) return ("%.3g %%"):format(100 * row.scheme_error) end},
  {name = "failed", accepts = failed, value = function() return 0 end,
   text = function(row) return row.message end},
}

-- The worst runs, with `describe` of their throws in the last column.
local function worst_rows(rows, describe)
  local list = {}
  for _, kind in ipairs(worst_kinds) do
    for _, row in ipairs(worst(rows, kind.accepts, kind.value)) do
      list[#list + 1] = {kind.name, row.throw.number, row.level or "none", kind.text(row),
                         describe(row.throw)}
    end
  end
  return list, {"worst", "throw", "level", "value", "body and scene"}
end

-- As description, for a line of a terminal.
local function short_description(throw)
  return ("%s, %s, E %.3g MPa, ratio %.3g, %.3g m/s"):format(throw.shape, throw.base,
    throw.young / 1e6, throw.ratio, throw.speed)
end

-- Prints the counts and the worst runs, and writes them to `path`. `repeated`: the command that
-- repeats throw N.
function summary.publish(path, rows, repeated)
  local counted = counts(rows)
  print(s.format_table(counted, {columns = count_columns}))
  local text = "# Throws\n\n" .. markdown.table(counted, count_columns) .. "\n"
  local shown, columns = worst_rows(rows, short_description)
  if #shown > 0 then
    local how = ("Repeat throw N, with all its parameters, with: %s"):format(repeated)
    print("\n" .. s.format_table(shown, {columns = columns}) .. "\n\n" .. how)
    text = ("%s\n%s\n\n%s\n"):format(text,
      markdown.table(worst_rows(rows, summary.description)), how)
  end
  s.save_text(path, text)
end

-- Ledger error against speed over wave speed, by what happened to the body.
function summary.chart(stem, rows)
  local series = {
    {name = "shape kept", accepts = function(row) return not on_the_way(row) end},
    {name = "corners inverted on the way", accepts = function(row)
      return on_the_way(row) and not at_end(row)
    end},
    {name = "corners inverted at the end", accepts = at_end},
  }
  -- Smaller errors are drawn at this one, without the labels that the option y_from adds.
  local shown, least = {}, 1e-6
  for _, one in ipairs(series) do
    one.joined, one.points = false, {}
    for _, row in ipairs(rows) do
      if not row.error and one.accepts(row) then
        table.insert(one.points, {row.throw.speed / row.throw.wave_speed,
                                  math.max(row.ledger_error, least)})
      end
    end
    one.accepts = nil
    shown[#shown + 1] = #one.points > 0 and one or nil
  end
  if #shown == 0 then return end
  command.chart(stem, shown, {
    title = "Random throws: error of the energy ledger", log_x = true, log_y = true,
    x_label = "speed / slowest wave speed",
    y_label = "ledger error / largest kinetic energy (at least 10⁻⁶)",
  })
end

-- The story of one run: some of its frames, from the first to the last.
function summary.timeline(model, run)
  local lines, last, ledger = 16, run.frame_count, run.ledger
  local list = {}
  for i = 1, math.min(lines, last) do
    local number = last <= lines and i or 1 + (i - 1) * (last - 1) // (lines - 1)
    local entry, frame = ledger[number], run:frame(number)
    list[i] = {
      entry.time, #model:inverted_corners(frame), entry.kinetic, entry.elastic, entry.contact,
      entry.lost_damping, entry.lost_friction, entry.lost_contact, entry.lost_corners,
      entry.lost_scheme, entry.lost_switch, entry.total - ledger[1].total,
    }
  end
  return s.format_table(list, {columns = {
    "time [s]", "inverted", "kinetic [J]", "elastic [J]", "contact [J]", "lost to damping [J]",
    "friction [J]", "contact loss [J]", "corners [J]", "scheme [J]", "step changes [J]",
    "ledger gap [J]",
  }})
end

return summary
