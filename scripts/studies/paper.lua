-- Makes the paper's tables and figures again, with intervals and a noise floor; goes on if stopped.

local s = require "springlod"
local command = require "lib.command"
local paper_figures = require "studies.paper.figures"
local paper_numbers = require "studies.paper.numbers"
local paper_runs = require "studies.paper.runs"
local paper_studies = require "studies.paper.studies"
local paper_tables = require "studies.paper.tables"
local paper_variants = require "studies.paper.variants"
local run_store = require "lib.run_store"

local parser = command.parser("paper", "Makes the tables and figures of Kot, Nagahashi and Gracki, "
  .. "\"Simplification of mass spring models\", from many runs each: CSV files, charts, tables.md "
  .. "and figure-N.png. Stopped with Ctrl-C, the same command goes on where it was.")
parser:option("--out", "folder to write to"):argname("<folder>"):default("out/paper")
parser:flag("--quick", "few runs: to see that it works, not to conclude from")
parser:option("--starts", "paired starts of each model (default: 48; quick: 8)")
  :convert(command.whole("--starts", 5))
parser:option("--simplifications", "seeds of each way of merging (default: 5; quick: 2)")
  :convert(command.whole("--simplifications", 1))
parser:option("--jitter", "relative change of speed and height from start to start")
  :convert(command.number("--jitter", 0)):default("0.02")
parser:option("--margin", "spreads of the base that still count as the same")
  :convert(command.number("--margin", 0)):default("0.5")
parser:option("--friction", "of floor and wall")
  :convert(command.number("--friction", 0, true)):default("0.5")
parser:option("--ball-speed", "m/s at which the ball is thrown")
  :convert(command.number("--ball-speed", 0)):default("3.2")
parser:option("--speeds", "of the rods, in the paper's units (default: the paper's six; quick: 30)")
  :argname("<speed>"):args("+"):convert(command.number("--speeds", 0))
parser:option("--speed-scale", "m/s of one of the paper's units of speed")
  :convert(command.number("--speed-scale", 0)):default("0.26")
parser:option("--ball-materials", "Lua file that returns core and shell"):argname("<file.lua>")
parser:option("--rods-materials", "Lua file that returns rod and rubber"):argname("<file.lua>")
parser:flag("--calibrated", "also levels of 45 and 20 % of the nodes fitted to the base: LOD-fit-b "
  .. "(the paper's groups), LOD-fit-compact-b, and LOD-fit-compact-s and -sp that touch at the "
  .. "base's surface; goes on in a folder without them too")
parser:option("--variants", "these ways only, fitted ones among them or not")
  :argname("<name>"):args("+"):choices(paper_variants.labels())
parser:flag("--no-figures", "tables only")
local args = parser:parse()

local settings = {
  starts = args.starts or (args.quick and 8 or 48),
  simplifications = args.simplifications or (args.quick and 2 or 5),
  jitter = args.jitter, margin = args.margin, friction = args.friction, seed = s.seed,
  ball_speed = args.ball_speed, speed_scale = args.speed_scale,
  speeds = args.speeds or (args.quick and {30} or paper_numbers.speeds),
  variants = args.variants
    or (args.calibrated and paper_variants.labels() or paper_variants.paper_labels()),
  ball_materials = args.ball_materials and command.load_table(args.ball_materials),
  rods_materials = args.rods_materials and command.load_table(args.rods_materials),
}

-- All that a run depends on.
local function run_settings()
  return {
    springlod = s.version, starts = settings.starts, jitter = settings.jitter,
    friction = settings.friction, seed = settings.seed, ball_speed = settings.ball_speed,
    simplifications = settings.simplifications, speed_scale = settings.speed_scale,
    ball_materials = settings.ball_materials or "samples",
    rods_materials = settings.rods_materials or "samples",
    speeds = table.concat(settings.speeds, " "),
  }
end

local page = {} -- lines of tables.md

local function write_page(line) page[#page + 1] = line end

-- A table on the terminal, in tables.md and, with all its digits, as a CSV file.
local function publish(name, title, rows, columns, shown, shown_columns)
  s.csv(("%s/%s.csv"):format(args.out, name), rows, {columns = columns})
  shown, shown_columns = shown or rows, shown_columns or columns
  print("\n" .. title .. "\n")
  print(s.format_table(shown, {columns = shown_columns}))
  write_page(("\n## %s\n\n| %s |\n|%s"):format(title, table.concat(shown_columns, " | "),
    ("---|"):rep(#shown_columns)))
  for _, row in ipairs(shown) do
    local cells = {}
    for i, column in ipairs(shown_columns) do
      local cell = row[i] == nil and row[column] or row[i]
      if math.type(cell) == "float" then cell = ("%.4g"):format(cell) end
      cells[i] = tostring(cell == nil and "" or cell)
    end
    write_page("| " .. table.concat(cells, " | ") .. " |")
  end
end

local function table_1(ball)
  local rows = paper_tables.rows(ball, settings)
  publish("table-1", "Table 1: how far the ball rolls", rows, paper_tables.columns,
    paper_tables.readable(rows))
  -- A line a variant, through the base and its levels.
  local function point(row)
    return {row.ends, row.distance, label = row.model, low = row.distance_low,
            high = row.distance_high}
  end
  local series = {{name = "base", points = {point(rows[1])}}}
  for i = 2, #rows, 2 do
    series[#series + 1] = {
      name = rows[i].model:gsub("-1$", ""), points = {point(rows[i]), point(rows[i + 1])},
    }
  end
  command.chart(args.out .. "/table-1-chart", series, {
    title = "Table 1: how far the ball rolls, mean of the starts and its 95 % interval",
    x_label = "ends of springs", y_label = "distance [m]",
  })
end

local function table_2(rods)
  local all, lines = {}, {}
  local beside = 0.08 -- units of speed from model to model, so that no interval hides another
  for _, one in ipairs(rods) do
    local rows = paper_tables.rows(one, settings)
    for i, row in ipairs(rows) do
      all[#all + 1] = row
      if not lines[row.model] then
        lines[row.model] = {name = row.model, points = {}}
        lines[#lines + 1] = lines[row.model]
      end
      table.insert(lines[row.model].points, {
        one.speed + beside * (i - 1), row.distance, low = row.distance_low,
        high = row.distance_high,
      })
    end
    publish("table-2-speed-" .. one.speed, ("Table 2: final distance from the wall, speed %g")
      :format(one.speed), rows, paper_tables.columns, paper_tables.readable(rows))
  end
  s.csv(args.out .. "/table-2.csv", all, {columns = paper_tables.columns})
  publish("table-2-over-speeds", "Table 2 over the speeds: mean |difference from the base| [m]",
    paper_tables.over_speeds(rods, all))
  command.chart(args.out .. "/table-2-chart", lines, {
    title = "Table 2: final distance from the wall, means and their 95 % intervals",
    x_label = "speed (the paper's units)", y_label = "distance [m]",
  })
end

local function paper()
  local cases = paper_runs.cases(settings) -- first, for wrong materials must not get into a store
  local store = run_store.open(args.out .. "/runs", run_settings())
  local all = {cases.ball, table.unpack(cases.rods)}
  paper_runs.run(all, settings, store)
  write_page("# The paper's tables, made again\n")
  write_page(("%d paired starts, %d simplification seeds, jitter %g, friction %g, 1 unit of speed "
    .. "= %g m/s, seed %d. W1: 1-Wasserstein distance; inside: simplification seeds whose distance "
    .. "lies below the noise floor; same: shown to be within %g spreads of the base; "
    .. "turned: runs in which springs turned over."):format(
    settings.starts, settings.simplifications, settings.jitter, settings.friction,
    settings.speed_scale, settings.seed, settings.margin))
  table_1(cases.ball)
  table_2(cases.rods)
  if not args.no_figures then
    paper_figures.draw(args.out, {seed = settings.seed, quick = args.quick})
  end
  publish("early-errors", "Before chaos: mean distance from the base's nodes [m]",
    paper_studies.early_errors({cases.ball, cases.rods[1]}, settings, store))
  publish("three-runs", "The paper's way: three runs with steps that differ [m]",
    paper_studies.three_runs(cases.rods, settings, store))
  publish("energy", "Largest energy difference over the base's largest kinetic energy",
    paper_studies.energy({cases.ball, cases.rods[1]}, settings, store))
  publish("elasticity", "Elasticity alone: the ten lowest frequencies against the base's",
    paper_studies.elasticity(settings, store))
  publish("random-models", "Random models: eq. 2 against a stretch test",
    paper_studies.random_models(settings, store))
  publish("sensitivity", "What a scene makes of a start that is 0.1 % off",
    paper_studies.sensitivity(settings, store))
end

local ok, reason = command.try(paper)
if not ok then command.fail("paper: %s", reason) end
s.save_text(args.out .. "/tables.md", table.concat(page, "\n") .. "\n")
s.say("tables.md, CSV files, charts and figures are in " .. args.out)
