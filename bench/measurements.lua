-- Reads the JSON output of Google Benchmark, which has one key per line and no nested objects.

local measurements = {}

local function value_of(text)
  if text == "true" then return true end
  return tonumber(text) or text:match('^"(.*)"$')
end

-- Removes suffixes such as /real_time and /repeats:5, which describe the measurement.
local function plain_name(name)
  for _, mark in ipairs{"/real_time", "/manual_time", "/process_time", "/repeats:%d+",
                        "/iterations:%d+", "/min_time:[%d.]+"} do
    name = name:gsub(mark, "")
  end
  return name
end

local nanoseconds = {ns = 1, us = 1e3, ms = 1e6, s = 1e9}

local own_keys = {
  name = true, family_index = true, per_family_instance_index = true, run_name = true,
  run_type = true, repetitions = true, repetition_index = true, threads = true, iterations = true,
  real_time = true, cpu_time = true, time_unit = true, label = true, aggregate_name = true,
  aggregate_unit = true, error_occurred = true, error_message = true,
}

local function measurement(raw, program)
  local unit = nanoseconds[raw.time_unit or "ns"] / 1e6
  local row = {program = program, name = plain_name(raw.run_name), label = raw.label or "",
               counters = {}}
  if raw.error_occurred then
    row.failed = raw.error_message
    return row
  end
  row.real_ms, row.cpu_ms = raw.real_time * unit, raw.cpu_time * unit
  -- The time that the benchmark selects: wall clock or processor.
  local by_clock = raw.run_name:match("/real_time") or raw.run_name:match("/manual_time")
  row.ms = by_clock and row.real_ms or row.cpu_ms
  for key, value in pairs(raw) do
    if not own_keys[key] then row.counters[key] = value end
  end
  return row
end

-- The measurements of a file in its order, and its context (machine, compiler). Repetitions give
-- the least time and the spread.
function measurements.read(path, program)
  local context, by_name, names = {}, {}, {}
  local raw = context
  local function keep()
    if raw.aggregate_name == "cv" then
      local row = by_name[plain_name(raw.run_name)]
      if row then row.spread = raw.cpu_time end
      return
    end
    if raw.aggregate_name and raw.aggregate_name ~= "least" then return end
    local row = measurement(raw, program)
    local known = by_name[row.name]
    if known and (row.failed or not known.failed and known.real_ms <= row.real_ms) then return end
    if not known then names[#names + 1] = row.name end
    if known then row.spread = known.spread end
    by_name[row.name] = row
  end
  for line in io.lines(path) do
    local key, text = line:match('^%s*"([^"]+)": (.-),?%s*$')
    if line:match('^%s*"benchmarks"') then
      raw = nil
    elseif raw ~= context and line:match("^%s*{") then
      raw = {}
    elseif raw and raw ~= context and line:match("^%s*}") then
      keep()
      raw = nil
    elseif key and raw then
      raw[key] = value_of(text)
    end
  end
  local rows = {}
  for i, name in ipairs(names) do rows[i] = by_name[name] end
  return rows, context
end

return measurements
