-- Compare single and double precision on vibrating and falling bodies.

local s = require "springlod"
local command = require "lib.command"
local unit_store = require "lib.unit_store"
local vibration = require "studies.precision.vibration"

local parser = command.parser("precision", "Compare single and double precision: bodies vibrate in "
  .. "their ten lowest modes and drop on a floor. Writes frequencies.csv, amplitudes.csv, "
  .. "rest.csv, drops.csv, differences.csv, chart.svg and chart.png.")
command.add_out(parser, "out/precision", "folder", true)
parser:flag("--quick", "skip the body of 20,000 nodes and use fewer periods; takes seconds")
local args = parser:parse()

local mode_count = 10
local periods = args.quick and 8 or 20
local samples = 12 -- per period
-- Largest displacement over the size of the body. Small enough that the geometric nonlinearity of
-- springs shifts frequencies by at most 0.01 %, and large enough to be a visible motion.
local amplitude = 1e-3
local amplitudes = {1e-2, 1e-3, 1e-4, 1e-5, 1e-6}
local safety = 0.8 -- fraction of the stable step, the default of runs
local frame_rate = 40 -- of drops [1/s]
local timed = args.quick and 1 or 3 -- timed drops; the fastest counts
local precisions = {"double", "single"}

-- 1. Bodies. `make` takes a damping time [s]; `floor` is the contact stiffness [N/m3], similar to
-- that of the surface.

local function block(size, cell)
  return function(damping)
    return s.lattice(s.grid{cell = cell, size = size, fill = function() return "bar" end,
      materials = {bar = {young = "1 MPa", density = 1000, damping = damping}}})
  end
end

local mesh = s.import(s.samples .. "/dumbbell.obj", {unit = "dm", up = "z"})

local function rods(damping)
  local materials = dofile(s.samples .. "/dumbbell_materials.lua")
  for _, material in pairs(materials) do material.damping = damping end
  return s.lattice(s.voxelize(mesh, {cell = "10 cm", materials = materials}))
end

local bar = block({24, 4, 3}, 0.02)
local bodies = {
  {name = "bar", make = bar, floor = 5e7},
  {name = "bar, level 1", floor = 5e7,
    make = function(damping) return s.simplify(bar(damping), {levels = 1})[1] end},
  {name = "rods", make = rods, floor = 2e6},
}
if not args.quick then
  table.insert(bodies, {name = "block", make = block({29, 26, 24}, 0.02), floor = 5e7,
    large = true}) -- skips the study of rest, which would take minutes
end

-- 2. Frequencies of free vibration in time integration.

-- The start displaced along a mode; `most` is the largest node displacement.
local function displaced(nodes, shape, most)
  local largest = 0
  for _, u in ipairs(shape) do
    largest = math.max(largest, math.sqrt(u[1] ^ 2 + u[2] ^ 2 + u[3] ^ 2))
  end
  local factor, x = most / largest, {}
  for i, node in ipairs(nodes) do
    local u = shape[i]
    x[i] = {node.x + factor * u[1], node.y + factor * u[2], node.z + factor * u[3]}
  end
  return {x = x}
end

-- Modal coordinate in each frame of a run: mass-weighted projection of the displacement on the
-- mode.
local function modal_coordinate(run, nodes, shape)
  local times, values = {}, {}
  for number = 1, run.frame_count do
    local frame, sum = run:frame(number), 0
    for i, node in ipairs(nodes) do
      local x, u = frame.x[i], shape[i]
      sum = sum + node.mass
        * (u[1] * (x[1] - node.x) + u[2] * (x[2] - node.y) + u[3] * (x[3] - node.z))
    end
    times[number], values[number] = frame.time, sum
  end
  return times, values
end

-- Vibration in one mode in both precisions. `stepped`: the frequency that leapfrog gives a mode of
-- angular frequency omega, 2/dt asin(omega dt/2).
local function vibrate_mode(body, mode, relative_amplitude)
  local step = safety * s.stable_step(body.model)
  local stepped = math.asin(math.pi * mode.frequency * step) / (math.pi * step)
  local every = step * math.max(1, math.floor(1 / (samples * stepped * step)))
  local frames = math.ceil(periods / (stepped * every))
  local start = displaced(body.nodes, mode.shape, relative_amplitude * body.size)
  local fits, times = {}, nil
  for _, precision in ipairs(precisions) do
    local run = s.run(body.model, {gravity = {0, 0, 0}, duration = frames * every},
      {start = start, step = step, precision = precision, frame_rate = 1 / every, ledger = false})
    local values
    times, values = modal_coordinate(run, body.nodes, mode.shape)
    fits[precision] = vibration.fit(times, values, stepped)
  end
  local double, single = fits.double.frequency, fits.single.frequency
  return {
    modal = mode.frequency, stepped = stepped, double = double, single = single,
    difference = single / double - 1,
    error = vibration.error_of_difference(fits.double, fits.single, times) / double,
    method_error = double / stepped - 1,
  }
end

-- The vibrations in each mode, and in the lowest mode with each amplitude.
local function vibrate_body(body)
  local modes = s.modes(body.model, {count = mode_count, accuracy = 1e-10, seed = s.seed})
  local vibrations, by_amplitude = {}, {}
  for i, mode in ipairs(modes) do vibrations[i] = vibrate_mode(body, mode, amplitude) end
  for i, relative in ipairs(amplitudes) do
    by_amplitude[i] = vibrate_mode(body, modes[1], relative)
  end
  return {vibrations = vibrations, by_amplitude = by_amplitude}
end

-- 3. A drop.

-- Height of the lowest node [m]; low enough that the softest material does not invert.
local fall = 0.1

local function scene_of(body, height, duration)
  return {duration = duration,
    throw = {position = {0, 0, height}, velocity = {0.5, 0, 0}, spin = {0.3, 0.6, 0},
      turn = {axis = {1, 0.4, 0}, angle = "8 deg"}},
    obstacles = {{plane = {0, 0, 1, 0}, stiffness = body.floor, friction = 0.5}}}
end

-- The drop of a body and one time step for all its runs: the shortest step that a run with
-- automatic step reduction uses, rounded so that frames are multiples of it.
local function plan_drop(body, model)
  local look = s.run(model, scene_of(body, 0, 1e-3), {frame_rate = 0, quiet = true})
  local lowest = 0
  for _, x in ipairs(look:frame(1).x) do lowest = math.min(lowest, x[3]) end
  local scene = s.scenario(scene_of(body, fall - lowest, 1))
  local trial = s.run(model, scene, {precision = "single", frame_rate = 0, ledger = false})
  return scene, 1 / (frame_rate * math.ceil(1 / (frame_rate * trial.shortest_step)))
end

-- Rms and largest distance between corresponding nodes, relative to `size`.
local function distances(one, other, size)
  local squares, most = 0, 0
  for i, p in ipairs(one) do
    local q = other[i]
    local square = (p[1] - q[1]) ^ 2 + (p[2] - q[2]) ^ 2 + (p[3] - q[3]) ^ 2
    squares, most = squares + square, math.max(most, square)
  end
  return math.sqrt(squares / #one) / size, math.sqrt(most) / size
end

-- Differences of two runs by frame: time, rms and largest.
local function differences(run, reference, size)
  local list = {}
  for number = 1, reference.frame_count do
    local frame = reference:frame(number)
    local rms, most = distances(run:frame(number).x, frame.x, size)
    list[number] = {time = frame.time, rms = rms, most = most}
  end
  return list
end

-- Largest change of total energy relative to the largest kinetic energy.
local function ledger_error(run)
  local ledger = run.ledger
  local change, kinetic = 0, 0
  for _, entry in ipairs(ledger) do
    change = math.max(change, math.abs(entry.total - ledger[1].total))
    kinetic = math.max(kinetic, entry.kinetic)
  end
  return change / kinetic
end

-- Processor time of the fastest of `timed` drops [s].
local function time_of(model, scene, options)
  local least = math.huge
  for _ = 1, timed do
    local before = os.clock()
    s.run(model, scene, options)
    least = math.min(least, os.clock() - before)
  end
  return least
end

local function drop_body(body)
  local model = body.make("0.5 ms")
  local scene, step = plan_drop(body, model)
  local function drop(precision, length) -- no sleeping, so that runs are comparable to the end
    return s.run(model, scene, {step = length, precision = precision, sleep = 0,
      frame_rate = frame_rate})
  end
  local double, single, half = drop("double", step), drop("single", step), drop("double", step / 2)
  local found = {step = step, contact = double.first_contact,
    precision = differences(single, double, body.size),
    step_halved = differences(half, double, body.size),
    ledger = {double = ledger_error(double), single = ledger_error(single)}, time = {}}
  for _, precision in ipairs(precisions) do
    found.time[precision] = time_of(model, scene, {step = step, precision = precision,
      sleep = 0, frame_rate = 0, ledger = false, threads = 1})
  end
  return found
end

-- The last frame before the body touched the floor.
local function before_contact(list, contact)
  local last = list[1]
  for _, entry in ipairs(list) do
    if entry.time < contact then last = entry end
  end
  return last
end

-- 4. A body at rest, which only rounding errors move.

local rest_time = args.quick and 1 or 10 -- [s]

-- Rms displacement relative to the size, after a tenth of the time and after all of it.
local function drift(body, damping)
  local model = body.make(damping)
  local run = s.run(model, {gravity = {0, 0, 0}, duration = rest_time},
    {precision = "single", frame_rate = 10 / rest_time, ledger = false})
  local list = {}
  for i, number in ipairs{2, 11} do
    list[i] = distances(run:frame(number).x, run:frame(1).x, body.size)
  end
  return list
end

local function rest_body(body)
  local list = {}
  for _, damping in ipairs(body.large and {} or {0, 5e-4}) do
    list[#list + 1] = {damping, table.unpack(drift(body, damping))}
  end
  return list
end

local function measure(body, store)
  body.model = body.make(0)
  body.nodes, body.size = body.model:nodes(), body.model.bounds.diagonal
  local function kept(what, make)
    local value = store:value(body.name .. ": " .. what, function() return make(body) end)
    s.say(("%s: %s done"):format(body.name, what))
    return value
  end
  local vibrating = kept("vibrations", vibrate_body)
  body.vibrations, body.by_amplitude = vibrating.vibrations, vibrating.by_amplitude
  body.drop, body.rest = kept("drops", drop_body), kept("rest", rest_body)
end

-- 5. Tables and chart.

local frequency_columns = {"body", "nodes", "mode", "modal [Hz]", "stepped [Hz]", "double [Hz]",
  "single [Hz]", "single / double - 1", "standard error", "double / stepped - 1"}

local function frequency_rows()
  local rows = {}
  for _, body in ipairs(bodies) do
    for i, one in ipairs(body.vibrations) do
      rows[#rows + 1] = {body.name, #body.nodes, i, one.modal, one.stepped, one.double, one.single,
        one.difference, one.error, one.method_error}
    end
  end
  return rows
end

local amplitude_columns = {"body", "amplitude / size", "single / double - 1", "standard error",
  "double / stepped - 1"}

local function amplitude_rows()
  local rows = {}
  for _, body in ipairs(bodies) do
    for i, relative in ipairs(amplitudes) do
      local one = body.by_amplitude[i]
      rows[#rows + 1] = {body.name, relative, one.difference, one.error, one.method_error}
    end
  end
  return rows
end

local rest_columns = {"body", "damping [s]", ("moved in %g s"):format(rest_time / 10),
  ("moved in %g s"):format(rest_time)}

local function rest_rows()
  local rows = {}
  for _, body in ipairs(bodies) do
    for _, row in ipairs(body.rest) do rows[#rows + 1] = {body.name, table.unpack(row)} end
  end
  return rows
end

local drop_columns = {"body", "nodes", "step [s]", "first contact [s]", "rms before contact",
  "largest before contact", "rms at 1 s", "largest at 1 s", "rms at 1 s of half the step",
  "ledger double", "ledger single", "double [s]", "single [s]", "double / single"}

local function drop_rows()
  local rows = {}
  for i, body in ipairs(bodies) do
    local drop = body.drop
    local list = drop.precision
    local falling, last = before_contact(list, drop.contact), list[#list]
    rows[i] = {body.name, #body.nodes, drop.step, drop.contact, falling.rms, falling.most, last.rms,
      last.most, drop.step_halved[#list].rms, drop.ledger.double, drop.ledger.single,
      drop.time.double, drop.time.single, drop.time.double / drop.time.single}
  end
  return rows
end

local difference_columns = {"body", "time [s]", "single: rms", "single: largest",
  "half the step: rms", "half the step: largest"}

local function difference_rows()
  local rows = {}
  for _, body in ipairs(bodies) do
    for i, one in ipairs(body.drop.precision) do
      local other = body.drop.step_halved[i]
      rows[#rows + 1] = {body.name, one.time, one.rms, one.most, other.rms, other.most}
    end
  end
  return rows
end

-- Charts the differences of the first body and of the last, the largest.
local function draw(folder)
  local series = {}
  for _, body in ipairs{bodies[1], bodies[#bodies]} do
    for _, kind in ipairs{{"step_halved", "half the step"}, {"precision", "single precision"}} do
      local points = {}
      for i = 2, #body.drop.precision do -- the first frames are equal
        local entry = body.drop[kind[1]][i]
        points[#points + 1] = {entry.time, entry.rms}
      end
      series[#series + 1] = {name = ("%s: %s"):format(body.name, kind[2]), points = points}
    end
  end
  command.chart(folder .. "/chart", series, {
    title = "A drop, against double precision with the whole step",
    x_label = "time [s]", y_label = "distance of nodes, rms / size of the body", log_y = true,
  })
end

-- Prints rows; `formats` holds the number format of columns.
local function show(rows, columns, formats)
  local texts = {}
  for i, row in ipairs(rows) do
    texts[i] = {}
    for k, value in ipairs(row) do
      texts[i][k] = formats[k] and formats[k]:format(value) or value
    end
  end
  print(s.format_table(texts, {columns = columns}))
  print()
end

local ok, failure = command.try_in(args.folder, function()
  local store = unit_store.open(args.folder, {quick = args.quick or false})
  for _, body in ipairs(bodies) do measure(body, store) end
  local tables = {
    {"frequencies", frequency_rows(), frequency_columns,
      {[4] = "%.6g", [5] = "%.6g", [6] = "%.9g", [7] = "%.9g", [8] = "%+.1e", [9] = "%.0e",
        [10] = "%+.1e"}},
    {"amplitudes", amplitude_rows(), amplitude_columns,
      {[2] = "%.0e", [3] = "%+.1e", [4] = "%.0e", [5] = "%+.1e"}},
    {"rest", rest_rows(), rest_columns, {[3] = "%.1e", [4] = "%.1e"}},
    {"drops", drop_rows(), drop_columns,
      {[3] = "%.2e", [4] = "%.3f", [5] = "%.1e", [6] = "%.1e", [7] = "%.1e", [8] = "%.1e",
        [9] = "%.1e", [10] = "%.1e", [11] = "%.1e", [12] = "%.3g", [13] = "%.3g", [14] = "%.2f"}},
    {"differences", difference_rows(), difference_columns},
  }
  for _, one in ipairs(tables) do
    local name, rows, columns, formats = table.unpack(one)
    s.csv(("%s/%s.csv"):format(args.folder, name), rows, {columns = columns})
    if formats then show(rows, columns, formats) end
  end
  draw(args.folder)
  store:remove()
end, true)
if not ok then command.fail("precision: %s", failure) end
s.say("wrote " .. args.folder)
