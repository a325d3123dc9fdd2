-- Compare what levels gain in scenes, by the clock, with their certificates.

local s = require "springlod"
local bodies = require "studies.gains.bodies"
local clock = require "studies.gains.clock"
local command = require "lib.command"
local conversion = require "lib.conversion"
local lists = require "lib.lists"
local progress = require "lib.progress"
local scenes = require "studies.picks.scenes"
local unit_store = require "lib.unit_store"

local keep = {0.45, 0.2}
local making = conversion.presets.best.simplify -- how convert makes levels
local usual_column = "clock_" .. making.contact

local all_scenes = lists.joined(scenes.tuning, scenes.checking)

local parser = command.parser("gains", "Measure how much less processor time levels take than "
  .. "their base in scenes, each on its fastest kernel, and compare it with the gains by "
  .. "certificate. Levels have 45 % and 20 % of the nodes of the base and are made as by convert. "
  .. "Prints all gains, and writes gains.csv, means.csv (geometric means over bodies), and the "
  .. "chart clock-certificate.svg and .png.")
command.add_out(parser, "out/gains", "folder", true)
local function choice(name, all, default)
  parser:option("--" .. name, ("any of %s (default: %s)"):format(
      table.concat(lists.names_of(all), ", "), default))
    :argname("<list>"):convert(command.words_of("--" .. name, lists.names_of(all)))
end
choice("bodies", bodies, "all")
choice("scenes", all_scenes, "the last six")
parser:option("--repeats", "number of measurements of each gain; the median counts"):default("5")
  :convert(command.whole("--repeats", 1))
parser:flag("--quick", "use one small body, one scene and a short fit; takes seconds")
local args = parser:parse()
local least_seconds = args.quick and 0.002 or 0.02 -- of processor time in each measurement
if args.quick then args.bodies, args.scenes, args.repeats = {"cube"}, {"skid"}, 1 end

-- Those of the list that are named, all if `names` is nil.
local function chosen(list, names)
  local wanted, found = {}, {}
  for _, name in ipairs(names or lists.names_of(list)) do wanted[name] = true end
  for i, name in ipairs(lists.names_of(list)) do
    if wanted[name] then found[#found + 1] = list[i] end
  end
  return found
end

local chosen_bodies = chosen(bodies, args.bodies)
local chosen_scenes = chosen(args.scenes and all_scenes or scenes.checking, args.scenes)

local function make_chain(base)
  local options = {keep = keep}
  for name, value in pairs(making) do options[name] = value end
  if args.quick then options.calibration = {iterations = 3} end
  return s.simplify(base, options)
end

-- What is compared: columns of the results.
local gains = {"plain", "certificate"}
for _, way in ipairs(clock.ways) do gains[#gains + 1] = way.column end
gains[#gains + 1] = "clock_over_certificate"

local rows = {}

-- A row. `level`: of s.info. `measured`: of clock.gains.
local function row_of(names, level, measured)
  local c = level.certificate
  local row = {
    body = names.body, scene = names.scene, base_nodes = names.base_nodes,
    level = level.level, nodes = level.nodes, base_kernel = c.base_kernel, kernel = c.kernel,
    plain = c.base_cost / c.cost, certificate = 1 / c.seconds_ratio,
  }
  for _, way in ipairs(clock.ways) do row[way.column] = measured[way.column].value end
  local usual = measured[usual_column]
  row.low, row.high, row.updates = usual.low, usual.high, usual.updates
  row.clock_over_certificate = usual.value / row.certificate
  return row
end

local function measured_rows(body)
  local found, base = {}, body.make()
  local chain = make_chain(base)
  local levels = s.info(chain).levels
  local frequency = s.modes(base, {count = 1})[1].frequency
  for _, scene in ipairs(chosen_scenes) do
    local names = {body = body.name, scene = scene[1], base_nodes = base.node_count}
    local conditions = scene[2](base.bounds.diagonal, frequency)
    for level = 1, #keep do
      local ok, result = command.try(clock.gains, base, chain[level], conditions, args.repeats,
        least_seconds)
      if ok then
        found[#found + 1] = row_of(names, levels[level + 1], result)
      else -- such as a thin body that passes through an obstacle
        s.say(("%s, %s, level %d: left out: %s"):format(body.name, scene[1], level, result))
      end
    end
  end
  return found
end

local function geometric_mean(list, key)
  local sum = 0
  for _, row in ipairs(list) do sum = sum + math.log(row[key]) end
  return math.exp(sum / #list)
end

-- Means over the bodies for each scene, and over all rows.
local function mean_rows()
  local groups, order = {}, {}
  local function add(scene, row)
    local key = scene .. row.level
    if not groups[key] then
      groups[key] = {scene = scene, level = row.level, rows = {}}
      order[#order + 1] = groups[key]
    end
    table.insert(groups[key].rows, row)
  end
  for _, row in ipairs(rows) do add(row.scene, row) end
  for _, row in ipairs(rows) do add("all", row) end
  local means = {}
  for i, group in ipairs(order) do
    means[i] = {scene = group.scene, level = group.level, bodies = #group.rows}
    for _, gain in ipairs(gains) do means[i][gain] = geometric_mean(group.rows, gain) end
  end
  return means
end

local meanings = [[
A gain is the cost of the base over that of the level. plain: spring updates; certificate: predicted
by the certificate, with the speed of the kernels; clock: measured in the scene, with contact at
nodes, at the surface, in flight without obstacles, and at nodes with the same kernel for both.
clock over certificate: measured over predicted.]]

local function show(list, columns)
  local texts, titles = {}, {}
  for k, column in ipairs(columns) do titles[k] = column:gsub("_", " ") end
  for i, row in ipairs(list) do
    texts[i] = {}
    for k, column in ipairs(columns) do
      local value = row[column]
      texts[i][k] = math.type(value) == "float" and ("%.2f"):format(value) or value
    end
  end
  print(s.format_table(texts, {columns = titles}))
end

-- Clock against certificate for each scene, and the line on which they agree.
local function draw()
  local by_scene, series = {}, {}
  local least, most = math.huge, 0
  for _, row in ipairs(rows) do
    local one = by_scene[row.scene]
    if not one then
      one = {name = row.scene, joined = false, points = {}}
      by_scene[row.scene], series[#series + 1] = one, one
    end
    local x, y = row.certificate, row[usual_column]
    table.insert(one.points, {x, y})
    least, most = math.min(least, x, y), math.max(most, x, y)
  end
  series[#series + 1] = {name = "as by certificate", colour = "grey", symbol = "none",
                         points = {{least, least}, {most, most}}}
  command.chart(args.folder .. "/clock-certificate", series, {
    title = "Gains of levels, each model on its fastest kernel", log_x = true, log_y = true,
    x_label = "gain by certificate", y_label = "gain in the scene, by the clock", height = 700,
  })
end

local ok, failure = command.try_in(args.folder, function()
  local store = unit_store.open(args.folder, {
    scenes = lists.names_of(chosen_scenes), repeats = args.repeats, quick = args.quick or false,
  })
  local done = progress(#chosen_bodies)
  for _, body in ipairs(chosen_bodies) do
    local found = store:value(body.name, function() return measured_rows(body) end)
    table.move(found, 1, #found, #rows + 1, rows)
    done(body.name)
  end
  if #rows == 0 then error("no run succeeded", 0) end
  s.csv(args.folder .. "/gains.csv", rows, {columns = lists.joined(
    {"body", "scene", "level", "base_nodes", "nodes", "base_kernel", "kernel"}, gains,
    {"low", "high", "updates"})})
  local means, mean_columns = mean_rows(), lists.joined({"scene", "level", "bodies"}, gains)
  s.csv(args.folder .. "/means.csv", means, {columns = mean_columns})
  show(rows, lists.joined({"body", "scene", "level", "nodes"}, gains))
  print("\ngeometric means over bodies")
  show(means, mean_columns)
  print(meanings)
  draw()
  store:remove()
end, true)
if not ok then command.fail("gains: %s", failure) end
s.say("wrote " .. args.folder)
