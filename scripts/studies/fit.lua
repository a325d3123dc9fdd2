-- Measure what the fit of levels gains, in vibration, impacts and landings.

local s = require "springlod"
local bodies = require "studies.fit.bodies"
local command = require "lib.command"
local landing = require "studies.fit.landing"
local lists = require "lib.lists"
local motion = require "studies.fit.motion"
local show = require "lib.show"
local split_table = require "lib.split_table"
local trade_off = require "studies.fit.trade_off"
local unit_store = require "lib.unit_store"

local keep = {0.45, 0.2}
local patch_radius = 2.2 -- of the small patches [mean spring lengths]
local waves = 6 -- of a velocity field
local field_count = 3 -- velocity fields for each level
local periods, samples = 5, 24 -- of f1, and frames in each
-- Largest displacement over the size of the body, roughly: small enough that the nonlinearity of
-- the springs is below the errors that are measured.
local amplitude = 1e-4

local variants = {
  {name = "plain"},
  {name = "free", calibration = {masses = "free"}},
  {name = "default", calibration = {}},
}

local parser = command.parser("fit", "Measure levels with 45 % and 20 % of the nodes of their "
  .. "base, in compact groups: merged only (plain), fitted with free masses (free), and fitted by "
  .. "default (default). The last two columns are errors against the base after it was thrown at a "
  .. "floor with friction, with contact at the surface: rms over the first 50 ms after the first "
  .. "contact, and over the next 150 ms, in percent of the body's diagonal. Writes "
  .. "levels.csv and means.csv (means over bodies and seeds), and prints the latter.")
command.add_out(parser, "out/fit", "folder", true)
parser:option("--bodies", "any of " .. table.concat(lists.names_of(bodies), ", ")
  .. ", or samples, others or firm for a set of them"):default("others")
parser:option("--seeds", "number of seeds for each body"):default("2")
  :convert(command.whole("--seeds", 1))
parser:option("--variants", "Lua file that returns a list of {name = ..., calibration = {...}} to "
  .. "measure in place of the three"):argname("<file.lua>")
  :convert(command.table_file("--variants"))
parser:option("--landings", "number of directions from which each body lands; 0: none")
  :default("4"):convert(command.whole("--landings", 0))
parser:flag("--trade-off", "measure fits that aim at different highest frequencies, in place of "
  .. "the three, and draw gain against errors (trade-off.svg and .png); no landings")
parser:flag("--landings-only", "measure only landings")
parser:flag("--quick", "use one seed of one small body and few steps; takes seconds")
local args = parser:parse()
if args.quick then args.bodies, args.seeds, args.landings = "beam", 1, 1 end
if args.trade_off then
  if args.variants or args.landings_only then
    parser:error("--trade-off has variants of its own and no landings")
  end
  args.variants, args.landings = trade_off.variants(), 0
end
local compared = args.variants or variants

local function chosen_bodies()
  local known, chosen = {samples = true, others = true, firm = true}, {}
  for _, body in ipairs(bodies) do known[body.name] = true end
  for word in (args.bodies .. ","):gmatch("%s*(.-)%s*,") do
    if not known[word] then
      error(("--bodies: '%s' must be samples, others, firm or one of %s"):format(word,
        table.concat(lists.names_of(bodies), ", ")), 0)
    end
    for _, body in ipairs(bodies) do
      if body.name == word or body.set == word then chosen[#chosen + 1] = body end
    end
  end
  return chosen
end

-- The nodes of a model with their positions and masses as lists.
local function nodes_of(model)
  local nodes, places, masses = model:nodes(), {}, {}
  for i, node in ipairs(nodes) do places[i], masses[i] = {node.x, node.y, node.z}, node.mass end
  return {model = model, list = nodes, places = places, masses = masses}
end

local function displacements(frame, places)
  local list = {}
  for i, x in ipairs(frame.x) do
    list[i] = {x[1] - places[i][1], x[2] - places[i][2], x[3] - places[i][3]}
  end
  return list
end

-- Free motion from rest with the given velocities, frame by frame.
local function vibrate(nodes, velocities, period)
  return s.run(nodes.model, {gravity = {0, 0, 0}, duration = periods * period},
    {start = {v = velocities}, frame_rate = samples / period, ledger = false, quiet = true})
end

-- Velocity fields of the base without rigid motion, and the motion that follows from each. f1 in
-- Hz.
local function move_base(body, frequency)
  body.nodes, body.period, body.fields = nodes_of(body.base), 1 / frequency, {}
  local size = body.base.bounds
  for number = 1, field_count do
    local field, velocities = motion.smooth_field(size, number, waves), {}
    for i, node in ipairs(body.nodes.list) do velocities[i] = field(node) end
    local vibrating = motion.without_rigid(body.nodes.places, body.nodes.masses, velocities)
    local factor = 2 * math.pi * frequency * amplitude * size.diagonal
    for _, v in ipairs(vibrating) do for d = 1, 3 do v[d] = factor * v[d] end end
    body.fields[number] = {velocities = velocities, vibrating = vibrating,
      run = vibrate(body.nodes, vibrating, body.period)}
  end
end

-- Errors of a level in motion [1]: of the velocities right after an impulse, of the first period,
-- and of the following ones.
local function motion_errors(body, chain, level)
  local nodes, map = nodes_of(chain[level]), chain:group_map(level)
  local ones = {}
  for i = 1, #body.nodes.list do ones[i] = {1, 0, 0} end
  local group_masses = {}
  for g, sum in ipairs(motion.momenta(body.nodes.list, ones, map, #nodes.list)) do
    group_masses[g] = sum[1]
  end
  local function means(field)
    local momenta = motion.momenta(body.nodes.list, field, map, #nodes.list)
    return motion.divided(momenta, group_masses), momenta
  end
  local squares, sizes = {impulse = 0, first = 0, later = 0}, {impulse = 0, first = 0, later = 0}
  local function add(kind, difference, size)
    squares[kind], sizes[kind] = squares[kind] + difference, sizes[kind] + size
  end
  for _, field in ipairs(body.fields) do
    local wanted, momenta = means(field.velocities)
    add("impulse", motion.squares(group_masses, motion.divided(momenta, nodes.masses), wanted))
    local run = vibrate(nodes, (means(field.vibrating)), body.period)
    for number = 2, field.run.frame_count do
      local frame = field.run:frame(number)
      local moved = motion.without_rigid(nodes.places, group_masses,
        (means(displacements(frame, body.nodes.places))))
      local found = motion.without_rigid(nodes.places, nodes.masses,
        displacements(run:frame(number), nodes.places))
      add(frame.time < 1.0001 * body.period and "first" or "later",
        motion.squares(group_masses, found, moved))
    end
  end
  local errors = {}
  for kind, sum in pairs(squares) do errors[kind] = math.sqrt(sum / sizes[kind]) end
  return errors
end

-- Young's modulus over the base's, of the material for which it is farthest from 1.
local function worst_modulus(certificate)
  local worst = 1
  for _, m in ipairs(certificate.moduli) do
    local ratio = m.young / m.base_young
    if math.abs(math.log(ratio)) > math.abs(math.log(worst)) then worst = ratio end
  end
  return worst
end

-- The columns that describe a level; errors in percent. `l` has certificate, patches (a certificate
-- with small patches), motion, landing, and seconds (of the fit of both levels).
local elastic_measures = {
  {"f1..10", function(l) return 100 * l.certificate.f1_10_error end},
  {"f11..20", function(l) return 100 * (l.certificate.f11_20_error or 0) end},
  {"MAC", function(l) return l.certificate.mac end},
  {"smooth loads", function(l) return 100 * l.certificate.fitted_load_error end},
  {"held-out loads", function(l) return 100 * l.certificate.held_out_load_error end},
  {"small patches", function(l) return 100 * l.patches.held_out_load_error end},
  {"modulus", function(l) return worst_modulus(l.certificate) end},
  {"area / mass", function(l) return l.certificate.contact_ratio end},
  {"gain", function(l) return l.certificate.base_cost / l.certificate.cost end},
  {"impulse", function(l) return 100 * l.motion.impulse end},
  {"period 1", function(l) return 100 * l.motion.first end},
  {"periods 2..5", function(l) return 100 * l.motion.later end},
}
local landing_measures = {
  {"landing 0..50 ms", function(l) return 100 * l.landing.early end},
  {"landing 50..200 ms", function(l) return 100 * l.landing.late end},
}

local measures = {}
if not args.landings_only then
  table.move(elastic_measures, 1, #elastic_measures, 1, measures)
end
if args.landings > 0 then
  table.move(landing_measures, 1, #landing_measures, #measures + 1, measures)
end
measures[#measures + 1] = {"seconds", function(l) return l.seconds end}

local function make_chain(body, variant, seed)
  local options = {keep = keep, seed = seed, grouping = "compact"}
  if variant.calibration then
    options.calibrate, options.calibration = "modes", {}
    for name, value in pairs(variant.calibration) do options.calibration[name] = value end
    if args.quick then options.calibration.iterations = 3 end
  end
  local before = os.clock()
  local chain = s.simplify(body.base, options)
  return chain, os.clock() - before
end

local rows, sums = {}, {}

local function note(body, variant, seed, level, values)
  local row = {body.name, variant, seed, level}
  table.move(values, 1, #values, #row + 1, row)
  rows[#rows + 1] = row
  local key = level .. " " .. variant
  sums[key] = sums[key] or {count = 0}
  local sum = sums[key]
  sum.count = sum.count + 1
  for i, value in ipairs(values) do sum[i] = (sum[i] or 0) + value end
end

-- Adds a list for each level: name of the variant, seed, level, and the values of the measures.
local function measure(body, variant, seed, found)
  local chain, seconds = make_chain(body, variant, seed)
  local certified, patches
  if not args.landings_only then
    certified = s.info(s.certify(chain)).levels
    patches = s.info(s.certify(chain, {modes = 1, radius = patch_radius})).levels
  end
  for level = 1, #keep do
    local of_level = {seconds = seconds}
    if certified then
      of_level.certificate = certified[level + 1].certificate
      of_level.patches = patches[level + 1].certificate
      of_level.motion = motion_errors(body, chain, level)
    end
    if body.landings then of_level.landing = landing.errors(chain[level], body.landings) end
    local values = {}
    for i, one in ipairs(measures) do values[i] = one[2](of_level) end
    found[#found + 1] = {variant.name, seed, level, values}
  end
end

local function measured_levels(body)
  body.base = body.make()
  if not args.landings_only then
    move_base(body, s.modes(body.base, {count = 1})[1].frequency)
  end
  if args.landings > 0 then
    body.landings = landing.of_base(body.base, args.landings)
    local noise = body.landings.noise
    s.say(("%s: the base at half its step differs by %.2g %% in the first 50 ms after landing, "
      .. "%.2g %% later"):format(body.name, 100 * noise.early, 100 * noise.late))
  end
  local found = {}
  for seed = 1, args.seeds do
    for _, variant in ipairs(compared) do measure(body, variant, seed, found) end
  end
  s.say(("%s: %d nodes measured"):format(body.name, body.base.node_count))
  return found
end

-- Everything that the levels of a body depend on.
local function store_settings()
  return {variants = compared, seeds = args.seeds, landings = args.landings,
          landings_only = args.landings_only or false, quick = args.quick or false}
end

local function mean_rows()
  local list = {}
  for level = 1, #keep do
    for _, variant in ipairs(compared) do
      local sum = sums[level .. " " .. variant.name]
      local row = {level, variant.name, sum.count}
      for i = 1, #measures do row[#row + 1] = sum[i] / sum.count end
      list[#list + 1] = row
    end
  end
  return list
end

-- Names of columns, followed by those of the measures.
local function with_measures(columns)
  for _, one in ipairs(measures) do columns[#columns + 1] = one[1] end
  return columns
end

-- What is not an error: as a number, or with its unit.
local texts_of = {
  MAC = function(value) return ("%.3f"):format(value) end,
  modulus = show.full, ["area / mass"] = show.full, gain = show.full,
  seconds = function(value) return show.measured(value, "time", 2) end,
}

local meanings = [[
Means over bodies and seeds. Level 1 has 45 %, level 2 20 % of the nodes. f1..10, f11..20: errors of
natural frequencies; MAC: agreement of mode shapes, 1 is best. loads: errors of the compliance under
smooth loads, under loads that no fit sees, and under those on small patches. modulus: over the
base's, of the material that is farthest off. area / mass: the largest contact area over mass of a
node, over the base's. gain: spring updates of the base over those of the level. impulse, period:
errors of the free body's motion right after an impact, in the first and in later periods. landing:
rms distance of the surface after the first contact. seconds: of the fit of both levels.]]

local function print_means(list)
  local texts, columns = {}, with_measures{"level", "variant"}
  for i, row in ipairs(list) do
    texts[i] = {row[1], row[2]}
    for k = 4, #row do
      local text_of = texts_of[columns[k - 1]]
      texts[i][k - 1] = text_of and text_of(row[k]) or show.percent(row[k] / 100)
    end
  end
  print(split_table.format(texts, columns, 2))
  print(meanings)
end

local function draw_trade_off()
  trade_off.chart(args.folder, compared, #keep, function(level, variant, name)
    local sum = sums[level .. " " .. variant.name]
    for i, one in ipairs(measures) do
      if one[1] == name then return sum[i] / sum.count end
    end
  end)
end

local ok, failure = command.try_in(args.folder, function()
  local store = unit_store.open(args.folder, store_settings())
  for _, body in ipairs(chosen_bodies()) do
    local found = store:value(body.name, function() return measured_levels(body) end)
    for _, level in ipairs(found) do note(body, table.unpack(level)) end
  end
  s.csv(args.folder .. "/levels.csv", rows,
    {columns = with_measures{"body", "variant", "seed", "level"}})
  local list = mean_rows()
  s.csv(args.folder .. "/means.csv", list,
    {columns = with_measures{"level", "variant", "levels"}})
  print_means(list)
  if args.trade_off then draw_trade_off() end
  store:remove()
end, true)
if not ok then command.fail("fit: %s", failure) end
s.say("wrote " .. args.folder)
