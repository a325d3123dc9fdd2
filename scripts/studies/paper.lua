-- Reproduce the tables and figures of the paper with intervals and a noise floor.

local s = require "springlod"
local command = require "lib.command"
local markdown = require "lib.markdown"
local page = require "lib.page"
local paper_figures = require "studies.paper.figures"
local paper_numbers = require "studies.paper.numbers"
local paper_runs = require "studies.paper.runs"
local paper_studies = require "studies.paper.studies"
local paper_tables = require "studies.paper.tables"
local paper_variants = require "studies.paper.variants"
local show = require "lib.show"
local split_table = require "lib.split_table"
local study = require "lib.study"

local parser = command.parser("paper", "Reproduce the tables and figures of Kot, Nagahashi and "
  .. "Gracki, \"Simplification of mass spring models\", from many runs each. Writes index.html (a "
  .. "page with all of it), CSV files, charts, tables.md, figure-N.png and models/ (all levels). "
  .. "After an interruption (Ctrl-C) the same command resumes; springlod sweep plan paper makes a "
  .. "plan of it for other machines.")
command.add_out(parser, "out/paper")
parser:flag("--quick", "use few runs: a test of the command, without significance")
parser:option("--starts", "paired starts of each model (default: 48; --quick: 8)")
  :convert(command.whole("--starts", 5))
parser:option("--simplifications", "seeds of each simplification variant (default: 5; --quick: 2)")
  :convert(command.whole("--simplifications", 1))
parser:option("--jitter", "relative variation of speed and height between starts")
  :convert(command.number("--jitter", 0)):default("0.02")
parser:option("--margin", "equivalence margin in standard deviations of the base")
  :convert(command.number("--margin", 0)):default("0.5")
parser:option("--friction", "friction coefficient of floor and wall")
  :convert(command.number("--friction", 0, true)):default("0.5")
parser:option("--ball-speed", "speed at which the ball is thrown [m/s]")
  :convert(command.number("--ball-speed", 0)):default("3.2")
parser:option("--speeds", "speeds of the rods in the paper's unit (default: its six; --quick: 30)")
  :argname("<speed>"):args("+"):convert(command.number("--speeds", 0))
parser:option("--speed-scale", "one unit of speed of the paper [m/s]")
  :convert(command.number("--speed-scale", 0)):default("0.26")
parser:option("--ball-materials", "Lua file that returns materials core and shell")
  :argname("<file.lua>"):convert(command.table_file("--ball-materials"))
parser:option("--rods-materials", "Lua file that returns materials rod and rubber")
  :argname("<file.lua>"):convert(command.table_file("--rods-materials"))
parser:flag("--volumes", "give the models corners, which the paper's do not have: soft bodies keep "
  .. "their shape. The tables then count the runs with inverted corners at the end")
parser:flag("--calibrated", "add calibrated levels with 45 % and 20 % of the nodes: LOD-fit-b (the "
  .. "paper's groups), LOD-fit-compact-b, and LOD-fit-compact-s and -sp, whose contact is on the "
  .. "surface of the base")
parser:option("--variants", "run these variants only")
  :argname("<name>"):args("+"):choices(paper_variants.labels())
parser:flag("--no-figures", "write tables only")
local args = parser:parse()

local settings = {
  starts = args.starts or (args.quick and 8 or 48),
  simplifications = args.simplifications or (args.quick and 2 or 5),
  jitter = args.jitter, margin = args.margin, friction = args.friction, seed = s.seed,
  ball_speed = args.ball_speed, speed_scale = args.speed_scale,
  speeds = args.speeds or (args.quick and {30} or paper_numbers.speeds),
  variants = args.variants
    or (args.calibrated and paper_variants.labels() or paper_variants.paper_labels()),
  ball_materials = args.ball_materials, rods_materials = args.rods_materials,
  volumes = args.volumes or false,
}

local lines = {} -- of tables.md

local function write_line(line) lines[#lines + 1] = line end

local charts, tables = {}, {} -- of the page
local folder -- to write to
local note = "" -- after titles of charts: what is missing

local function draw(name, series, options)
  options.title = options.title .. note
  command.chart(("%s/%s"):format(folder, name), series, options)
  charts[#charts + 1] = {series, options}
end

-- Of the columns of tables 1 and 2.
local meanings = [[
ends: springs at both nodes. distance, W1, difference/spread: with 95 % intervals. spread: standard
deviation over the starts. difference: of the means, from the base's; paper's: the same there. W1:
Wasserstein distance from the ends of the base; floor: what other starts of the base reach; inside:
simplifications below it. same: whether the means are equivalent. turned: share of turned bodies.]]

-- For people, of lengths and ratios: less is nothing that a reader can tell from 0.
local least = 1e-4

local function number_of(value)
  local size = math.abs(value)
  if size == 0 or size >= least then return show.number(value) end
  return value > 0 and "< 0.0001" or "> -0.0001"
end

-- Writes a table to the terminal and the page, to tables.md and, with all digits, to a CSV file.
local function publish(name, title, rows, columns, shown, shown_columns)
  s.csv(("%s/%s.csv"):format(folder, name), rows, {columns = columns})
  shown, shown_columns = shown or rows, shown_columns or columns
  local texts = {}
  for number, row in ipairs(shown) do
    local cells = {}
    for i, column in ipairs(shown_columns) do
      local cell = row[i] == nil and row[column] or row[i]
      if math.type(cell) == "float" then cell = ("%.4g"):format(cell) end
      cells[i] = tostring(cell == nil and "" or cell)
    end
    texts[number] = cells
  end
  local names, short = {}, {}
  for i, column in ipairs(shown_columns) do names[i] = column:gsub("_", " ") end
  for number, row in ipairs(texts) do
    short[number] = {}
    for i, cell in ipairs(row) do
      local value = math.tointeger(cell) == nil and tonumber(cell)
      short[number][i] = value and shown == rows and number_of(value) or cell
    end
  end
  print("\n" .. title .. "\n")
  print(split_table.format(short, names, 1))
  if shown ~= rows then print(meanings) end
  tables[#tables + 1] = {title = title, rows = short, columns = names,
                         note = shown ~= rows and meanings:gsub("\n", " ") or nil}
  write_line(("\n## %s\n\n%s"):format(title, markdown.table(texts, shown_columns)))
end

local function table_1(ball, results)
  local rows = paper_tables.rows(ball, settings, results)
  publish("table-1", "Table 1: how far the ball rolls", rows, paper_tables.columns,
    paper_tables.readable(rows))
  -- One series per variant.
  local function point(row)
    return {row.ends, row.distance, label = row.model, low = row.distance_low,
            high = row.distance_high}
  end
  local series = {{name = "base", points = {point(rows[1])}}}
  for i = 2, #rows do
    local name = rows[i].model:gsub("-%d$", "")
    local of_level_1 = series[#series]
    if of_level_1.name == name then
      table.insert(of_level_1.points, point(rows[i]))
    else
      series[#series + 1] = {name = name, points = {point(rows[i])}}
    end
  end
  draw("table-1-chart", series, {
    title = "Table 1: how far the ball rolls, mean of the starts and its 95 % interval",
    x_label = "ends of springs", y_label = "distance [m]",
  })
end

local function table_2(rods, results)
  local all, means = {}, {}
  -- Models stand beside each other at each speed, so that intervals do not overlap; at a single
  -- speed they are numbered.
  local single = #rods == 1
  local low, high = math.huge, 0
  for _, one in ipairs(rods) do low, high = math.min(low, one.speed), math.max(high, one.speed) end
  local beside = single and 1 or 0.0025 * (high - low)
  for _, one in ipairs(rods) do
    local rows = paper_tables.rows(one, settings, results)
    for i, row in ipairs(rows) do
      all[#all + 1] = row
      if not means[row.model] then
        means[row.model] = {name = row.model, points = {}}
        means[#means + 1] = means[row.model]
      end
      table.insert(means[row.model].points, {
        (single and 1 or one.speed) + beside * (i - 1), row.distance, low = row.distance_low,
        high = row.distance_high, label = single and row.model or nil,
      })
    end
    publish("table-2-speed-" .. one.speed, ("Table 2: final distance from the wall, speed %g")
      :format(one.speed), rows, paper_tables.columns, paper_tables.readable(rows))
  end
  s.csv(folder .. "/table-2.csv", all, {columns = paper_tables.columns})
  publish("table-2-over-speeds", "Table 2 over the speeds: mean |difference from the base| [m]",
    paper_tables.over_speeds(rods, all))
  draw("table-2-chart", means, {
    title = "Table 2: final distance from the wall, means and their 95 % intervals",
    x_label = single and ("models in the order of the table, all at speed %g"):format(low)
      or "speed (the paper's units)",
    y_label = "distance [m]",
  })
end

-- Of --quick.
local untrustworthy = "A quick run with few starts: a test of the command. Its differences and "
  .. "intervals have no statistical significance."

local function write_page(summary, figures)
  local pictures = {}
  for i, figure in ipairs(figures) do
    pictures[i] = {path = ("%s/%s"):format(folder, figure.file), caption = figure.title}
  end
  page.write(folder .. "/index.html", {
    command = "paper", title = "The tables and figures of the paper, reproduced",
    verdict = args.quick and {untrustworthy, summary} or {summary}, charts = charts,
    tables = tables, pictures = pictures,
    line = command.line(args), provenance = page.provenance(nil, {
      {"paper", "Kot, Nagahashi and Gracki, Simplification of mass spring models, WorldComp CGV "
        .. "2012"}}),
  })
end

local cases

local function describe()
  cases = paper_runs.cases(settings)
  local all = {cases.ball, table.unpack(cases.rods)}
  local ball_and_rods = {cases.ball, cases.rods[1]}
  local stages = {
    paper_runs.chain_stage(all, settings), paper_runs.stage(all, settings),
    paper_studies.early_errors(ball_and_rods, settings),
    paper_studies.three_runs(cases.rods, settings), paper_studies.energy(ball_and_rods, settings),
    paper_studies.elasticity(settings), paper_studies.random_models(settings),
    paper_studies.sensitivity(settings),
  }
  for i = 3, #stages do stages[i].waits = false end
  return stages
end

-- Publishes the rows of a stage that is a table as it is.
local function publish_stage(results, name, title)
  publish(name, title, results:all(name), results:columns(name))
end

local function report(results, out)
  folder, note = out, results:note()
  write_line("# The tables of the paper, reproduced\n")
  local summary = ("%d paired starts, %d simplification seeds, jitter %g, friction %g, 1 unit of "
    .. "speed = %g m/s, seed %d. W1: 1-Wasserstein distance to the base; inside: simplification "
    .. "seeds whose W1 is below the noise floor; same: mean shown to be within %g spreads of the "
    .. "base; turned: runs %s."):format(
    settings.starts, settings.simplifications, settings.jitter, settings.friction,
    settings.speed_scale, settings.seed, settings.margin,
    settings.volumes and "that end with inverted corners" or "in which springs inverted")
  summary = summary .. note
  if args.quick then write_line(untrustworthy .. "\n") end
  write_line(summary)
  local balls = paper_runs.read({cases.ball}, settings, results)
  local rods = paper_runs.read(cases.rods, settings, results)
  if #balls > 0 then table_1(cases.ball, results) end
  if #rods > 0 then table_2(rods, results) end
  local figures = args.no_figures and {}
    or paper_figures.draw(folder, {seed = settings.seed, quick = args.quick})
  publish_stage(results, "early-errors", "Early errors: mean distance from the base's nodes [m]")
  publish_stage(results, "three-runs",
    "The paper's method: three runs with different time steps [m]")
  publish_stage(results, "energy",
    "Largest energy difference / largest kinetic energy of the base")
  publish_stage(results, "elasticity", "Elasticity: errors of the ten lowest frequencies")
  publish_stage(results, "random-models", "Random models: eq. 2 compared with a stretch test")
  publish_stage(results, "sensitivity", "Sensitivity: growth of a change of 0.1 % in the start")
  s.save_text(folder .. "/tables.md", table.concat(lines, "\n") .. "\n")
  write_page(summary, figures)
end

return study.run(args, {
  describe = describe, report = report, keep = true,
  hint = "--quick, --starts, --simplifications and --variants shorten it",
})
