-- Chart cost against error for all simplification methods and integrators.

local s = require "springlod"
local command = require "lib.command"
local page = require "lib.page"
local pareto_chains = require "studies.pareto.chains"
local pareto_charts = require "studies.pareto.charts"
local pareto_ensembles = require "studies.pareto.ensembles"
local pareto_surfaces = require "studies.pareto.surfaces"
local pareto_tables = require "studies.pareto.tables"
local pareto_times = require "studies.pareto.times"
local pareto_variants = require "studies.pareto.variants"
local run_estimate = require "lib.run_estimate"
local study = require "lib.study"

local all = pareto_variants.axes

local parser = command.parser("pareto", "Simplify the base of an asset with every combination of "
  .. "grouping, border rule and calibration, run the levels under one scenario with every "
  .. "integrator, precision and kind of contact, and chart the wall-clock cost of a simulated "
  .. "second against four errors: frequencies, loads, surface (until shortly after the first "
  .. "contact) and ensemble (final distances of many starts). Writes index.html (a page with all "
  .. "of it), NAME.svg, NAME.png, NAME.csv "
  .. "and NAME-front.csv for each error, points.csv, timings.csv (only the measured times, and "
  .. "what is drawn from them, vary between runs), left-out.csv, models/ (all levels) and "
  .. "command.txt. After an interruption (Ctrl-C) the same command resumes; springlod sweep plan "
  .. "pareto makes a plan of it for other machines.")
parser:argument("asset", "a .glb asset, written by convert or s.save; only its base is used")
parser:option("--scenario", "Lua file that returns a table for s.scenario")
  :argname("<file.lua>"):count(1)
command.add_out(parser, "out/pareto")
local function axis(name, help)
  parser:option("--" .. name, help .. " (default: all; --quick: few)"):argname("<list>")
    :convert(command.words_of("--" .. name, all[name]))
end
axis("groupings", "groupings, such as standard,compact")
axis("borders", "any of " .. table.concat(all.borders, ","))
axis("calibrations", "any of " .. table.concat(all.calibrations, ","))
axis("integrators", "integrators, such as symplectic_euler,xpbd")
axis("precisions", "any of " .. table.concat(all.precisions, ",")
  .. "; only symplectic_euler supports single")
axis("contacts", "any of " .. table.concat(all.contacts, ",")
  .. ": what of a level touches obstacles")
axis("errors", "any of " .. table.concat(all.errors, ",") .. "; ensemble takes longest")
parser:option("--keep", "node count of each level as a fraction of the base, such as 0.45,0.2 "
  .. "(default: as in the asset)"):argname("<fractions>"):convert(command.fractions("--keep"))
parser:option("--seeds", "seeds of each simplification method (default: 5; --quick: 1)")
  :convert(command.whole("--seeds", 1))
parser:option("--starts", "paired starts of each variant (default: 24; --quick: 5)")
  :convert(command.whole("--starts", 5))
parser:option("--jitter", "relative variation of speed and height between starts")
  :convert(command.number("--jitter", 0)):default("0.02")
parser:option("--repeats", "timed runs of each variant (default: 9; --quick: 3; slow ones: 3)")
  :convert(command.whole("--repeats", 1))
parser:option("--until", "time up to which surfaces are compared, such as 0.5s (default: 0.25 s "
  .. "after the first contact)"):convert(command.quantity("--until", "time"))
parser:option("--implicit-step", "time step of the implicit integrators, such as 2ms")
  :convert(command.quantity("--implicit-step", "time")):default("1ms")
parser:flag("--quick", "use few variants and runs: a test of the command, without significance")
local args = parser:parse()

local quick = args.quick and {
  groupings = {"standard", "compact"}, borders = {"none"}, calibrations = {"none", "modes"},
  integrators = {"symplectic_euler"}, seeds = 1, starts = 5, repeats = 3,
} or {seeds = 5, starts = 24, repeats = 9}

local axes = {}
for name, words in pairs(all) do axes[name] = args[name] or quick[name] or words end
local wanted = {}
for _, name in ipairs(axes.errors) do wanted[name] = true end

-- Node counts of the asset's levels as fractions of its base.
local function keep_of(asset)
  local keep = {}
  for i = 1, asset.coarsest do keep[i] = asset[i].node_count / asset[0].node_count end
  if #keep == 0 then
    error("the asset has only a base, so --keep must set the node counts of the levels: "
      .. "--keep 0.45,0.2", 0)
  end
  return keep
end

local function settings_of(asset)
  return {
    keep = args.keep or keep_of(asset), seeds = args.seeds or quick.seeds,
    starts = args.starts or quick.starts, repeats = args.repeats or quick.repeats,
    jitter = args.jitter, implicit_step = args.implicit_step, seed = s.seed,
    surface_time = args["until"],
  }
end

-- Processor time of a run of a variant to the end of the scenario [s]: a run of a level costs about
-- its share of the nodes. What cannot be run fails at once.
local function seconds_of(of)
  local found = {}
  return function(variant)
    local stepping = variant.stepping.name
    if not found[stepping] then
      found[stepping] = of.scenario.duration
        * (run_estimate.of(of.base, of.scene, variant.step_options) or 0)
    end
    return found[stepping] * (variant.level > 0 and of.settings.keep[variant.level] or 1)
  end
end

-- All levels of all methods with all ways to run them, the base first.
local function variants_of(methods, settings)
  local variants = {}
  for _, making in ipairs(methods) do
    local steppings = pareto_variants.steppings(axes, making)
    for level = making.grouping and 1 or 0, making.grouping and #settings.keep or 0 do
      for _, stepping in ipairs(steppings) do
        variants[#variants + 1] = pareto_variants.variant(making, level, stepping,
          settings.implicit_step)
      end
    end
  end
  if #variants == 0 or variants[1].making.grouping then
    error("nothing to run: only symplectic_euler supports single precision; add double to "
      .. "--precisions", 0)
  end
  return variants
end

local asset, current -- what is studied

local function describe()
  local scene = command.load_table(args.scenario)
  asset = s.load(args.asset)
  local settings = settings_of(asset)
  current = {
    base = asset[0], size = asset[0].bounds.diagonal, scene = scene, scenario = s.scenario(scene),
    settings = settings,
  }
  current.seconds = seconds_of(current)
  local methods = pareto_variants.methods(axes)
  current.variants = variants_of(methods, settings)
  local stages = {pareto_chains.stage(current, methods)}
  local function add(stage) stages[#stages + 1] = stage end
  if wanted.surface then
    add(pareto_surfaces.times_stage(current, current.variants[1]))
    add(pareto_surfaces.stage(current, current.variants))
  end
  if wanted.ensemble then add(pareto_ensembles.stage(current, current.variants)) end
  add(pareto_times.stage(current, current.variants))
  return stages
end

-- The measurements of each variant: {name, object, name of its method}. Those that have no base to
-- compare with are added to `left_out`.
local function measures_of(results, left_out)
  local measures = {}
  local function add(name, method, object, reason)
    current[name] = object
    if object then
      measures[#measures + 1] = {name, object, method}
    else
      left_out[#left_out + 1] = {"base", name, reason}
      s.say(("no %s: %s"):format(name, reason))
    end
  end
  if wanted.surface then add("surface", "error_of", pareto_surfaces.read(current, results)) end
  if wanted.ensemble then add("ensemble", "error_of", pareto_ensembles.read(current, results)) end
  add("cost", "cost_of", pareto_times.read(results))
  return measures
end

-- Errors and cost of a variant by name. Missing measurements are added to `left_out`.
local function measure(variant, elastic, measures, left_out)
  local found = {frequencies = wanted.frequencies and elastic.frequencies or nil,
                 loads = wanted.loads and elastic.loads or nil}
  for _, one in ipairs(measures) do
    local name, object, method = table.unpack(one)
    local reason
    found[name], reason = object[method](object, variant)
    if not found[name] then
      left_out[#left_out + 1] = {variant.name, name, reason}
      s.say(("%s: no %s: %s"):format(variant.label, name, reason))
    end
  end
  return found
end

-- The variants whose levels could be made, each with its field `measured`. Others are added to
-- `left_out`, once for each method.
local function measure_all(results, measures, left_out)
  local measured, told = {}, {}
  for _, variant in ipairs(current.variants) do
    local making = variant.making
    local elastic, reason = pareto_chains.read(current, results, making, variant.level)
    if elastic then
      variant.nodes, variant.springs = elastic.nodes, elastic.springs
      variant.measured = measure(variant, elastic, measures, left_out)
      measured[#measured + 1] = variant
    elseif not told[making] then
      told[making] = true
      left_out[#left_out + 1] = {making.name, "levels", reason}
      s.say(("%s: skipped: %s"):format(making.name, reason))
    end
  end
  return measured
end

-- The chart of each error. `note`: after titles.
local function charts_of(note)
  local name, charts = current.scenario.name, {
    {name = "frequencies", title = "Frequencies",
      y_label = "20 lowest frequencies, rms error [%]"},
    {name = "loads", title = "Local loads that no calibration is fitted to",
      y_label = "compliance, mean error [%]"},
  }
  if current.surface then
    charts[#charts + 1] = {name = "surface",
      title = ("Surfaces until shortly after contact (%s, up to %.2f s)"):format(name,
        current.surface.time),
      y_label = "distance from the base's, rms, mean over time [% of its size]",
      floor = current.surface.floor.value, floor_name = "half the step"}
  end
  if current.ensemble then
    charts[#charts + 1] = {name = "ensemble",
      title = ("Where %d starts end (%s)"):format(current.settings.starts, name),
      y_label = "Wasserstein distance from the base's [m]",
      floor = current.ensemble.floor.level, floor_name = "noise floor"}
  end
  for _, chart in ipairs(charts) do chart.title = chart.title .. note end
  return charts
end

-- The ends of a front in a sentence.
local function sentence(chart, front, count)
  local first, last = front[1], front[#front]
  return ("%s: %d of %d variants are on the Pareto front, from %s (%.2g of the cost of the base, "
    .. "error %.2g) to %s (%.2g of the cost, error %.2g)."):format(chart.title, #front, count,
    first.variant.label, first.x, first.y, last.variant.label, last.x, last.y)
end

local function write_page(folder, verdict, charts, tables)
  page.write(folder .. "/index.html", {
    command = "pareto", title = "Cost against error of every way to simplify "
      .. command.base_name(args.asset),
    verdict = verdict, view = s.view(asset), charts = charts, tables = tables,
    line = command.line(args), provenance = page.provenance(asset, {
      {"asset", ("%s (hash %s)"):format(args.asset, s.hash{file = args.asset})},
      {"scenario", ("%s (hash %s)"):format(args.scenario, s.hash{file = args.scenario})}}),
  })
end

-- Draws the charts and prints the fronts. Returns sentences, charts and tables for the page.
local function draw_charts(folder, variants, note)
  local x_label = ("wall-clock cost of a simulated second, base = 1 (base: %.3g s)"):format(
    current.cost:base_cost())
  local verdict, drawn, tables = {}, {}, {}
  for _, chart in ipairs(charts_of(note)) do
    if wanted[chart.name] then
      chart.x_label = x_label
      local front
      front, drawn[#drawn + 1] = pareto_charts.draw(folder, variants, chart)
      tables[#tables + 1] = pareto_tables.show_front(folder, chart, front)
      if #front > 0 then verdict[#verdict + 1] = sentence(chart, front, #variants) end
      if chart.name == "surface" then
        pareto_charts.draw_over_time(folder, front, current.surface.floor, chart.title)
      end
    end
  end
  return verdict, drawn, tables
end

local function report(results, folder)
  local left_out = {}
  local measures = measures_of(results, left_out)
  local variants = measure_all(results, measures, left_out)
  pareto_tables.save(folder, variants, left_out, current)
  local verdict, drawn, tables = draw_charts(folder, variants, results:note())
  print([[
A front has the variants than which no other is both cheaper and more accurate. cost / base: time
for a simulated second over that of the base, by the clock. In parentheses: 95 % intervals.]])
  s.save_text(folder .. "/command.txt", command.line(args) .. "\n")
  write_page(folder, verdict, drawn, tables)
  if #left_out > 0 then
    print(("failed levels and measurements: %d (see left-out.csv)"):format(#left_out))
  end
end

return study.run(args, {
  describe = describe, report = report, keep = true, failure = "pareto of " .. args.asset,
  hint = (args.quick and "" or "--quick, ") .. "fewer --errors, --starts and variants shorten it",
})
