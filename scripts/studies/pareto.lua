-- Chart cost against error for all simplification methods and integrators.

local s = require "springlod"
local command = require "lib.command"
local conversion = require "lib.conversion"
local page = require "lib.page"
local pareto_chains = require "studies.pareto.chains"
local pareto_charts = require "studies.pareto.charts"
local pareto_estimate = require "studies.pareto.estimate"
local pareto_ensembles = require "studies.pareto.ensembles"
local pareto_surfaces = require "studies.pareto.surfaces"
local pareto_tables = require "studies.pareto.tables"
local pareto_times = require "studies.pareto.times"
local pareto_variants = require "studies.pareto.variants"
local run_estimate = require "lib.run_estimate"
local run_store = require "lib.run_store"
local progress = require "lib.progress"

local all = pareto_variants.axes

local parser = command.parser("pareto", "Simplify the base of an asset with every combination of "
  .. "grouping, border rule and calibration, run the levels under one scenario with every "
  .. "integrator, precision and kind of contact, and chart the wall-clock cost of a simulated "
  .. "second against four errors: frequencies, loads, surface (until shortly after the first "
  .. "contact) and ensemble (final distances of many starts). Writes index.html (a page with all "
  .. "of it), NAME.svg, NAME.png, NAME.csv "
  .. "and NAME-front.csv for each error, points.csv, timings.csv (only the measured times, and "
  .. "what is drawn from them, vary between runs), left-out.csv, models/ (all levels) and "
  .. "command.txt. After an interruption (Ctrl-C) the same command resumes.")
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

-- Everything that kept results depend on. The axes and the number of seeds may change between runs.
local function store_settings(settings, scene)
  return {
    springlod = s.version, asset = s.hash{file = args.asset}, scene = scene, keep = settings.keep,
    starts = settings.starts, jitter = settings.jitter, seed = settings.seed,
    repeats = settings.repeats, implicit_step = settings.implicit_step,
    surface_time = settings.surface_time or "first contact",
  }
end

-- The measurements of each variant: {name, object, name of its method}.
local function measures_of(study)
  local measures = {}
  if wanted.surface then
    study.surfaces = pareto_surfaces.new(study)
    s.say(("surfaces are compared until %.3g s"):format(study.surfaces.time))
    measures[#measures + 1] = {"surface", study.surfaces, "error_of"}
  end
  if wanted.ensemble then
    study.ensembles = pareto_ensembles.new(study)
    measures[#measures + 1] = {"ensemble", study.ensembles, "error_of"}
  end
  study.times = pareto_times.new(study)
  measures[#measures + 1] = {"cost", study.times, "cost_of"}
  return measures
end

-- Errors and cost of a variant by name. Failed measurements are added to `left_out`.
local function measure(variant, chains, elastic, measures, left_out)
  local found = {frequencies = wanted.frequencies and elastic.frequencies or nil,
                 loads = wanted.loads and elastic.loads or nil}
  for _, one in ipairs(measures) do
    local name, object, method = table.unpack(one)
    local ok, result = command.try(object[method], object, variant, chains)
    if ok then
      found[name] = result
    else
      left_out[#left_out + 1] = {variant.name, name, result}
      s.say(("%s: no %s: %s"):format(variant.label, name, result))
    end
  end
  return found
end

local function measure_all(study, measures, left_out)
  local methods = pareto_variants.methods(axes)
  local base, steppings = methods[1], {}
  for _, making in ipairs(methods) do
    steppings[making] = pareto_variants.steppings(axes, making)
  end
  if #steppings[base] == 0 then
    error("nothing to run: only symplectic_euler supports single precision; add double to "
      .. "--precisions", 0)
  end
  local settings, variants = study.settings, {}
  local levels = #settings.keep
  local total = #steppings[base]
  for i = 2, #methods do total = total + settings.seeds + levels * #steppings[methods[i]] end
  local report = progress(total)
  for _, making in ipairs(methods) do
    local ok, chains = command.try(pareto_chains.of, study, making, report)
    if not ok then
      left_out[#left_out + 1] = {making.name, "levels", chains}
      s.say(("%s: skipped: %s"):format(making.name, chains))
    else
      for level = making.grouping and 1 or 0, making.grouping and levels or 0 do
        local elastic = pareto_chains.elastic_errors(chains, level)
        for _, stepping in ipairs(steppings[making]) do
          local variant = pareto_variants.variant(making, level, stepping, settings.implicit_step)
          variant.nodes = chains[1][level].node_count
          variant.springs = chains[1][level].spring_count
          variant.measured = measure(variant, chains, elastic, measures, left_out)
          variants[#variants + 1] = variant
          report(variant.label)
        end
      end
    end
  end
  return variants
end

-- The chart of each error.
local function charts_of(study)
  local name, charts = study.scenario.name, {
    {name = "frequencies", title = "Frequencies",
      y_label = "20 lowest frequencies, rms error [%]"},
    {name = "loads", title = "Local loads that no calibration is fitted to",
      y_label = "compliance, mean error [%]"},
  }
  if wanted.surface then
    charts[#charts + 1] = {name = "surface",
      title = ("Surfaces until shortly after contact (%s, up to %.2f s)"):format(name,
        study.surfaces.time),
      y_label = "distance from the base's, rms, mean over time [% of its size]",
      floor = study.surfaces.floor.value, floor_name = "half the step"}
  end
  if wanted.ensemble then
    charts[#charts + 1] = {name = "ensemble",
      title = ("Where %d starts end (%s)"):format(study.settings.starts, name),
      y_label = "Wasserstein distance from the base's [m]",
      floor = study.ensembles.floor.level, floor_name = "noise floor"}
  end
  return charts
end

-- The ends of a front in a sentence.
local function sentence(chart, front, count)
  local first, last = front[1], front[#front]
  return ("%s: %d of %d variants are on the Pareto front, from %s (%.2g of the cost of the base, "
    .. "error %.2g) to %s (%.2g of the cost, error %.2g)."):format(chart.title, #front, count,
    first.variant.label, first.x, first.y, last.variant.label, last.x, last.y)
end

local function write_page(asset, verdict, charts, tables)
  page.write(args.out .. "/index.html", {
    command = "pareto", title = "Cost against error of every way to simplify "
      .. command.base_name(args.asset),
    verdict = verdict, view = s.view(asset), charts = charts, tables = tables,
    line = command.line(), provenance = page.provenance(asset, {
      {"asset", ("%s (hash %s)"):format(args.asset, s.hash{file = args.asset})},
      {"scenario", ("%s (hash %s)"):format(args.scenario, s.hash{file = args.scenario})}}),
  })
end

local function report(study, asset, variants, left_out)
  pareto_tables.save(args.out, variants, left_out, study)
  local x_label = ("wall-clock cost of a simulated second, base = 1 (base: %.3g s)"):format(
    study.times:base_cost())
  local verdict, drawn, tables = {}, {}, {}
  for _, chart in ipairs(charts_of(study)) do
    if wanted[chart.name] then
      chart.x_label = x_label
      local front
      front, drawn[#drawn + 1] = pareto_charts.draw(args.out, variants, chart)
      tables[#tables + 1] = pareto_tables.show_front(args.out, chart, front)
      if #front > 0 then verdict[#verdict + 1] = sentence(chart, front, #variants) end
      if chart.name == "surface" then
        pareto_charts.draw_over_time(args.out, front, study.surfaces.floor, chart.title)
      end
    end
  end
  print([[
A front has the variants than which no other is both cheaper and more accurate. cost / base: time
for a simulated second over that of the base, by the clock. In parentheses: 95 % intervals.]])
  write_page(asset, verdict, drawn, tables)
  if #left_out > 0 then
    print(("failed levels and measurements: %d (see left-out.csv)"):format(#left_out))
  end
end

local function pareto()
  local scene, asset = command.load_table(args.scenario), s.load(args.asset)
  -- Before the store is opened, because either may be invalid.
  local settings, scenario = settings_of(asset), s.scenario(scene)
  local study = {
    base = asset[0], size = asset[0].bounds.diagonal, scene = scene, scenario = scenario,
    settings = settings, folder = args.out,
    store = run_store.open(args.out .. "/runs", store_settings(settings, scene)),
  }
  s.save_text(args.out .. "/command.txt", command.line() .. "\n")
  run_estimate.announce("all of it", pareto_estimate(study, axes, wanted, conversion.fit_time),
    (args.quick and "" or "--quick, ") .. "fewer --errors, --starts and variants shorten it")
  local measures, left_out = measures_of(study), {}
  report(study, asset, measure_all(study, measures, left_out), left_out)
end

local ok, reason = command.try_in(args.out, pareto, true)
if not ok then command.fail("pareto of %s: %s", args.asset, reason) end
s.say("wrote " .. args.out)
