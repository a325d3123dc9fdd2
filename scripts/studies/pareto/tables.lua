-- The tables of springlod pareto.

local s = require "springlod"
local show = require "lib.show"

local pareto_tables = {}

local function add_interval(row, interval)
  row[#row + 1] = interval and interval.value or ""
  row[#row + 1] = interval and interval.low or ""
  row[#row + 1] = interval and interval.high or ""
end

local function interval_columns(columns, name, unit)
  for _, bound in ipairs{"", " low", " high"} do
    columns[#columns + 1] = name .. bound .. unit
  end
end

local error_units = {{"frequencies", " [%]"}, {"loads", " [%]"}, {"surface", " [%]"},
                     {"ensemble", " [m]"}}

local function save_points(path, variants, study)
  local columns = {"variant", "label", "paper", "grouping", "border", "calibration", "level",
                   "nodes", "springs", "integrator", "precision", "contact"}
  for _, entry in ipairs(error_units) do interval_columns(columns, entry[1], entry[2]) end
  for _, name in ipairs{"surface floor [%]", "ensemble floor [m]", "seeds inside the floor"} do
    columns[#columns + 1] = name
  end
  local rows = {}
  for i, v in ipairs(variants) do
    local row = {v.name, v.label, v.paper or "", v.making.grouping or "", v.making.border or "",
                 v.making.calibration or "", v.level, v.nodes, v.springs, v.stepping.integrator,
                 v.stepping.precision, v.stepping.contact}
    for _, entry in ipairs(error_units) do add_interval(row, v.measured[entry[1]]) end
    row[#row + 1] = study.surface and study.surface.floor.value or ""
    row[#row + 1] = study.ensemble and study.ensemble.floor.level or ""
    row[#row + 1] = v.measured.ensemble and v.measured.ensemble.inside or ""
    rows[i] = row
  end
  s.csv(path, rows, {columns = columns})
end

local function save_timings(path, variants)
  local columns = {"variant", "label"}
  interval_columns(columns, "cost", " [s/s]")
  interval_columns(columns, "cost / base", "")
  for _, name in ipairs{"spring updates per simulated second", "step [s]", "repeats"} do
    columns[#columns + 1] = name
  end
  local rows = {}
  for _, v in ipairs(variants) do
    if v.measured.cost then
      local row = {v.name, v.label}
      add_interval(row, v.measured.cost.seconds)
      add_interval(row, v.measured.cost.ratio)
      row[#row + 1] = v.measured.cost.spring_updates
      row[#row + 1] = v.measured.cost.step
      row[#row + 1] = v.measured.cost.repeats
      rows[#rows + 1] = row
    end
  end
  s.csv(path, rows, {columns = columns})
end

function pareto_tables.save(folder, variants, left_out, study)
  save_points(folder .. "/points.csv", variants, study)
  save_timings(folder .. "/timings.csv", variants)
  s.csv(folder .. "/left-out.csv", left_out, {columns = {"variant", "what", "reason"}})
end

-- `text`: number -> text.
local function text_of(interval, text)
  if interval.value == interval.low and interval.value == interval.high then
    return text(interval.value) -- nothing varied
  end
  return ("%s (%s .. %s)"):format(text(interval.value), text(interval.low), text(interval.high))
end

-- How errors of an axis are shown, and its label without the unit that they then have themselves.
local function shown_by(axis)
  local label, metres = axis.y_label:gsub(" %[m%]$", "")
  if metres == 0 then return show.number, label end
  return function(value) return show.quantity(value, "length") end, label
end

-- Prints a front and writes it to folder/NAME-front.csv. Returns it as a table of a page.
function pareto_tables.show_front(folder, axis, front)
  local columns, rows, texts = {"variant", "label", "nodes"}, {}, {}
  local error_text, label = shown_by(axis)
  interval_columns(columns, "cost / base", "")
  interval_columns(columns, axis.y_label, "")
  for i, point in ipairs(front) do
    local v = point.variant
    rows[i] = {v.name, v.label, v.nodes}
    add_interval(rows[i], point.cost)
    add_interval(rows[i], point.error)
    texts[i] = {v.label, v.nodes, text_of(point.cost, show.number),
                text_of(point.error, error_text)}
  end
  s.csv(("%s/%s-front.csv"):format(folder, axis.name), rows, {columns = columns})
  print(axis.title .. ": the Pareto front" .. (axis.floor and
    ("; %s: %s"):format(axis.floor_name, error_text(axis.floor)) or ""))
  local shown = {"variant", "nodes", "cost / base", label}
  print(s.format_table(texts, {columns = shown}))
  print()
  return {title = axis.title .. ": the Pareto front", rows = texts, columns = shown}
end

return pareto_tables
