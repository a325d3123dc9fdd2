-- Turns the output of the benchmarks into the published results: a CSV file, a chart, and the
-- tables in docs/speed.md. Run by ./dev bench.

local folder = arg and arg[0] and arg[0]:match("^(.*)/") or "bench"
package.path = folder .. "/?.lua;" .. package.path

local s = require "springlod"
local command = require "lib.command"
local measurements = require "measurements"
local kernel_vectors = require "kernel_vectors"
local goals = require "goals"
local flight = require "flight"

local parser = command.parser("run bench/report.lua --", "Write results.csv, ns-per-spring.svg "
  .. "and .png, and the tables of the page from the JSON files of the benchmarks.")
parser:argument("measured", "folder with the JSON files of the benchmarks")
parser:option("--programs", "folder with the benchmark programs"):default("build/release/bench")
parser:option("--out", "folder of the published results"):default("bench/results")
parser:option("--page", "page whose marked tables are replaced"):default("docs/speed.md")
local args = parser:parse()

-- All measurements, in the order of programs and names, and by name.
local function read_all()
  local rows, by_name, context = {}, {}, {}
  for _, path in ipairs(s.files(args.measured, {endings = {".json"}})) do
    local program = command.stem(path)
    local read, machine = measurements.read(path, program)
    if program == "bench_step" then context = machine end
    table.sort(read, function(p, q) return p.name < q.name end)
    for _, row in ipairs(read) do
      if row.failed then s.say(("%s: %s: %s"):format(program, row.name, row.failed)) end
      rows[#rows + 1] = row
      by_name[row.name] = row
    end
  end
  return rows, by_name, context
end

local function processor()
  for line in io.lines("/proc/cpuinfo") do
    local name = line:match("^model name%s*: (.*)$")
    if name then return name end
  end
  return "unknown processor"
end

-- Adds lower bounds of the time per spring by vector units and by memory [ns] to step benchmarks.
local function add_bounds(rows, by_name, vectors)
  local machine = {}
  for _, name in ipairs{"read", "read_write", "vectors"} do
    local row = by_name["machine/" .. name]
    machine[name] = row and (row.counters.ns_per_byte or row.counters.ns_per_vector)
  end
  if not (machine.read and machine.read_write and machine.vectors) then return end
  for _, row in ipairs(rows) do
    local shape, _, precision = row.name:match("^step/(%a+)/(%w+)/(f%d+)")
    if shape and not row.failed then
      local layout = shape == "lattice" and "rows" or "quads"
      row.vectors = vectors[("%s/%s/%s"):format(layout, precision, row.label)]
      row.vector_bound = row.vectors and row.vectors * machine.vectors
      row.memory_bound = row.counters.bytes_read * machine.read
        + 2 * row.counters.bytes_changed * machine.read_write
    end
  end
end

local function rounded(value, digits)
  return value and tonumber(("%%.%dg"):format(digits or 4):format(value)) or ""
end

-- The other counters as one cell.
local own_columns = {nodes = true, springs = true, ns_per_spring = true}
local function other_counters(row)
  local words = {}
  for key, value in pairs(row.counters) do
    if not own_columns[key] then words[#words + 1] = ("%s=%.4g"):format(key, value) end
  end
  table.sort(words)
  return table.concat(words, " ")
end

local csv_columns = {"program", "benchmark", "vectors", "nodes", "springs", "ns_per_spring",
                     "vector_instructions_per_spring", "vector_bound_ns", "memory_bound_ns",
                     "ms", "spread", "others", "processor", "compiler"}

local function write_csv(rows, context)
  local cells, name = {}, processor()
  for _, row in ipairs(rows) do
    if not row.failed then
      local c = row.counters
      cells[#cells + 1] = {row.program, row.name, row.label, c.nodes or "", c.springs or "",
                           rounded(c.ns_per_spring), rounded(row.vectors),
                           rounded(row.vector_bound), rounded(row.memory_bound),
                           rounded(row.ms), rounded(row.spread, 2),
                           other_counters(row), name, context.compiler or ""}
    end
  end
  s.csv(args.out .. "/results.csv", cells, {columns = csv_columns})
end

local sizes = {"4k", "40k", "300k"}

-- The chart series of a benchmark: ns per spring by number of nodes.
local function series(by_name, name, pattern)
  local points = {}
  for _, size in ipairs(sizes) do
    local row = by_name[pattern:format(size)]
    local ns = row and not row.failed and row.counters.ns_per_spring
    if ns then points[#points + 1] = {row.counters.nodes, ns, label = ("%.3g"):format(ns)} end
  end
  return #points > 0 and {name = name, points = points} or nil
end

local function draw(by_name)
  local lines = {}
  local function add(...) lines[#lines + 1] = series(by_name, ...) end
  add("Bullet, explicit", "bullet/merged/%s/explicit")
  add("Bullet, one iteration", "bullet/merged/%s/iterations_1")
  add("naive f64, merged", "step/merged/%s/naive")
  add("ours, f64, merged", "step/merged/%s/f64")
  add("ours, f32, merged", "step/merged/%s/f32")
  add("ours, f64, lattice", "step/lattice/%s/f64")
  add("ours, f32, lattice", "step/lattice/%s/f32")
  if #lines == 0 then return end
  -- The script and data of the chart stay in the folder of the raw measurements.
  command.chart(args.measured .. "/ns-per-spring", lines, {
    title = "A step of a body on a floor: time per spring, one thread", x_label = "nodes",
    y_label = "ns per spring", log_x = true, log_y = true})
  for _, ending in ipairs{".svg", ".png"} do
    local drawn = args.measured .. "/ns-per-spring" .. ending
    if io.open(drawn) then
      assert(os.execute(("cp '%s' '%s/'"):format(drawn, args.out)))
    end
  end
end

-- Markdown.
local function table_text(rows, columns)
  local lines = {"| " .. table.concat(columns, " | ") .. " |",
                 "|" .. ("---|"):rep(#columns)}
  for _, row in ipairs(rows) do lines[#lines + 1] = "| " .. table.concat(row, " | ") .. " |" end
  return table.concat(lines, "\n")
end

local function machine_text(by_name, context)
  local function of(name, key, factor)
    local row = by_name["machine/" .. name]
    return row and ("%.3g"):format(factor / row.counters[key]) or "?"
  end
  local label = by_name["step/merged/4k/f32"]
  return ("%s, %d cores, vectors %s, %s. Measured in the same run, one thread: memory read at %s "
    .. "GB/s, read and written at %s GB/s; clock %s GHz; %s vector instructions per nanosecond.")
    :format(processor(), context.num_cpus or 0, label and label.label or "?",
            context.compiler or "unknown compiler", of("read", "ns_per_byte", 1),
            of("read_write", "ns_per_byte", 1), of("cycle", "ns_per_cycle", 1),
            of("vectors", "ns_per_vector", 1))
end

-- Kernels: times, bounds, and bounds as fractions of the times.
local function kernel_rows(by_name)
  local rows = {}
  local function add(shape, size, kernel)
    local row = by_name[("step/%s/%s/%s"):format(shape, size, kernel)]
    if not row or row.failed then return end
    local c = row.counters
    local function share(bound)
      return bound and ("%.2f (%.0f %%)"):format(bound, 100 * bound / c.ns_per_spring) or ""
    end
    local naive = by_name[("step/%s/%s/naive"):format(shape, size)]
    rows[#rows + 1] = {
      shape, ("%d"):format(c.nodes), (kernel:gsub("/avx2", "")), row.label,
      ("%.3g"):format(c.ns_per_spring),
      naive and ("%.2f"):format(c.ns_per_spring / naive.counters.ns_per_spring) or "",
      row.vectors and ("%.3g"):format(row.vectors) or "", share(row.vector_bound),
      c.bytes_read and ("%.0f + 2 x %.0f"):format(c.bytes_read, c.bytes_changed) or "",
      share(row.memory_bound)}
  end
  for _, shape in ipairs{"merged", "lattice"} do
    for _, size in ipairs(sizes) do
      for _, kernel in ipairs{"naive", "f32", "f32/avx2", "f64", "f64/avx2"} do
        add(shape, size, kernel)
      end
    end
  end
  return rows
end

local function bullet_rows(by_name)
  local rows = {}
  for _, size in ipairs{"4k", "40k"} do
    local ours = by_name[("step/merged/%s/f32"):format(size)]
    local function ns(kind)
      local row = by_name[("bullet/merged/%s/%s"):format(size, kind)]
      return row and not row.failed and row.counters.ns_per_spring
    end
    local function cell(value) return value and ("%.3g"):format(value) or "" end
    for _, order in ipairs{"sorted", "reordered"} do
      local ending = order == "sorted" and "" or "/reordered"
      local one, eleven = ns("iterations_1" .. ending), ns("iterations_11" .. ending)
      if ours and one and eleven then
        local sorted = order == "sorted"
        rows[#rows + 1] = {("%d"):format(ours.counters.nodes),
                           ("%d"):format(ours.counters.springs), order,
                           cell(ours.counters.ns_per_spring), cell(one), cell((eleven - one) / 10),
                           sorted and cell(ns("explicit")) or "",
                           sorted and cell(ns("explicit_undamped")) or ""}
      end
    end
  end
  return rows
end

local function time_rows(rows)
  local cells = {}
  for _, row in ipairs(rows) do
    if row.program ~= "bench_step" and not row.failed then
      cells[#cells + 1] = {row.name, row.ms >= 1000 and ("%.3g s"):format(row.ms / 1000)
                           or ("%.3g ms"):format(row.ms), other_counters(row)}
    end
  end
  return cells
end

-- Replaces the text between the two marks of a name in the page.
local function fill(page, mark, text)
  local first, last = ("<!-- %s -->"):format(mark), ("<!-- end of %s -->"):format(mark)
  local from, after = page:find(first, 1, true)
  local to = page:find(last, 1, true)
  if not (from and to) then error(("%s has no marks '%s'"):format(args.page, mark), 0) end
  return page:sub(1, after) .. "\n" .. text .. "\n" .. page:sub(to)
end

local function write_page(rows, by_name, context)
  local file = assert(io.open(args.page, "r"))
  local page = file:read("a")
  file:close()
  page = fill(page, "machine", machine_text(by_name, context))
  page = fill(page, "goals", table_text(goals.rows(by_name), {"goal", "limit", "measured", "met"}))
  page = fill(page, "kernels", table_text(kernel_rows(by_name), {
    "body", "nodes", "kernel", "vectors", "ns per spring", "/ naive", "vector instructions",
    "vector bound [ns]", "bytes", "memory bound [ns]"}))
  page = fill(page, "bullet", table_text(bullet_rows(by_name), {
    "nodes", "springs", "links", "ours, f32", "one iteration", "additional iteration", "explicit",
    "explicit, undamped"}))
  page = fill(page, "flight", table_text(flight.fit_rows(rows), flight.fit_columns))
  page = fill(page, "jobs", table_text(time_rows(rows), {"benchmark", "time", "counters"}))
  file = assert(io.open(args.page, "w"))
  file:write(page)
  file:close()
end

local rows, by_name, context = read_all()
if #rows == 0 then command.fail("%s holds no measurements (.json)", args.measured) end
assert(os.execute(("mkdir -p '%s'"):format(args.out)))
add_bounds(rows, by_name, kernel_vectors.count(args.programs .. "/bench_step"))
write_csv(rows, context)
draw(by_name)
write_page(rows, by_name, context)
print(s.format_table(goals.rows(by_name), {columns = {"goal", "limit", "measured", "met"}}))
s.say(("wrote %s/results.csv, %s/ns-per-spring.svg and .png, %s"):format(args.out, args.out,
                                                                         args.page))
