-- Draws cost against error for every way of making levels and of stepping them.

local s = require "springlod"
local command = require "lib.command"
local pareto_chains = require "studies.pareto.chains"
local pareto_charts = require "studies.pareto.charts"
local pareto_ensembles = require "studies.pareto.ensembles"
local pareto_surfaces = require "studies.pareto.surfaces"
local pareto_tables = require "studies.pareto.tables"
local pareto_times = require "studies.pareto.times"
local pareto_variants = require "studies.pareto.variants"
local run_store = require "lib.run_store"
local teller = require "lib.teller"

local all = pareto_variants.axes

local parser = command.parser("pareto", "Makes levels of an asset's base by every grouping, border "
  .. "rule and calibration, runs them under one scenario with every integrator and precision, and "
  .. "draws what a simulated second costs against four errors: frequencies, loads, surface (before "
  .. "the first chaos) and ensemble (where many starts end). Writes NAME.svg, NAME.png, NAME.csv "
  .. "and NAME-front.csv of each error, points.csv, timings.csv (measured times; these and what is "
  .. "drawn by them alone differ from run to run), left-out.csv, models/ (every level made) and "
  .. "command.txt. Stopped with Ctrl-C, the same command goes on where it was.")
parser:argument("asset", "a .glb that convert or save wrote; its base is what levels are made of")
parser:option("--scenario", "Lua file that returns a table for s.scenario")
  :argname("<file.lua>"):count(1)
parser:option("--out", "folder to write to"):argname("<folder>"):count(1)
local function axis(name, help)
  parser:option("--" .. name, help .. " (default: all; --quick: some)"):argname("<list>")
    :convert(command.words_of("--" .. name, all[name]))
end
axis("groupings", "such as standard,compact")
axis("borders", "of " .. table.concat(all.borders, ","))
axis("calibrations", "of " .. table.concat(all.calibrations, ","))
axis("integrators", "such as symplectic_euler,xpbd")
axis("precisions", "of " .. table.concat(all.precisions, ",")
  .. "; symplectic_euler alone has single")
axis("errors", "of " .. table.concat(all.errors, ",") .. "; the last takes longest")
parser:option("--keep", "nodes of each level over those of the base, such as 0.45,0.2 (default: "
  .. "the asset's)"):argname("<parts>"):convert(command.numbers("--keep", 0))
parser:option("--seeds", "chains of each way of making levels (default: 5; quick: 1)")
  :convert(command.whole("--seeds", 1))
parser:option("--starts", "paired starts of each run (default: 24; quick: 5)")
  :convert(command.whole("--starts", 5))
parser:option("--jitter", "relative change of speed and height from start to start")
  :convert(command.number("--jitter", 0)):default("0.02")
parser:option("--repeats", "timed runs of each (default: 9; quick: 3); slow ones get three")
  :convert(command.whole("--repeats", 1))
parser:option("--until", "surfaces are compared so long at most, such as 0.5s (default: to 0.25 s "
  .. "after the first contact)"):convert(command.quantity("--until", "time"))
parser:option("--implicit-step", "of the integrators whose step nothing bounds, such as 1ms")
  :convert(command.quantity("--implicit-step", "time")):default("1ms")
parser:flag("--quick", "few of everything: to see that it works, not to conclude from")
local args = parser:parse()

local quick = args.quick and {
  groupings = {"standard", "compact"}, borders = {"none"}, calibrations = {"none", "modes"},
  integrators = {"symplectic_euler"}, seeds = 1, starts = 5, repeats = 3,
} or {seeds = 5, starts = 24, repeats = 9}

local axes = {}
for name, words in pairs(all) do axes[name] = args[name] or quick[name] or words end
local wanted = {}
for _, name in ipairs(axes.errors) do wanted[name] = true end

-- Nodes of the asset's levels over those of its base.
local function keep_of(asset)
  local keep = {}
  for i = 1, asset.coarsest do keep[i] = asset[i].node_count / asset[0].node_count end
  if #keep == 0 then
    error("the asset has no levels besides its base; say how many nodes levels shall have: "
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

-- All that what is kept depends on; axes and seeds may grow from run to run.
local function store_settings(settings, scene)
  return {
    springlod = s.version, asset = s.hash{file = args.asset}, scene = scene, keep = settings.keep,
    starts = settings.starts, jitter = settings.jitter, seed = settings.seed,
    repeats = settings.repeats, implicit_step = settings.implicit_step,
    surface_time = settings.surface_time or "first contact",
  }
end

-- What a variant is measured by: by name, its method.
local function measures_of(study)
  local measures = {}
  if wanted.surface then
    study.surfaces = pareto_surfaces.new(study)
    s.say(("surfaces are compared until %.3g s"):format(study.surfaces.until_chaos))
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

-- Errors and cost of a variant by name; what fails goes into `left_out` and leaves the others be.
local function measure(variant, chains, elastic, measures, left_out)
  local found = {frequencies = wanted.frequencies and elastic.frequencies or nil,
                 loads = wanted.loads and elastic.loads or nil}
  for _, one in ipairs(measures) do
    local name, meter, method = table.unpack(one)
    local ok, result = command.try(meter[method], meter, variant, chains)
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
  local ways = pareto_variants.ways_of_making(axes)
  local steppings = pareto_variants.ways_of_stepping(axes)
  if #steppings == 0 then
    error("nothing to run: of the integrators symplectic_euler alone has single precision; add "
      .. "double to --precisions", 0)
  end
  local settings, variants = study.settings, {}
  local levels = #settings.keep
  local tell = teller(#steppings + (#ways - 1) * (settings.seeds + levels * #steppings))
  for _, making in ipairs(ways) do
    local ok, chains = command.try(pareto_chains.of, study, making, tell)
    if not ok then
      left_out[#left_out + 1] = {making.name, "levels", chains}
      s.say(("%s: left out: %s"):format(making.name, chains))
    else
      for level = making.grouping and 1 or 0, making.grouping and levels or 0 do
        local elastic = pareto_chains.elastic_errors(chains, level)
        for _, stepping in ipairs(steppings) do
          local variant = pareto_variants.variant(making, level, stepping, settings.implicit_step)
          variant.nodes = chains[1][level].node_count
          variant.springs = chains[1][level].spring_count
          variant.measured = measure(variant, chains, elastic, measures, left_out)
          variants[#variants + 1] = variant
          tell(variant.label)
        end
      end
    end
  end
  return variants
end

-- What is drawn of each error.
local function charts_of(study)
  local name, charts = study.scenario.name, {
    {name = "frequencies", title = "Frequencies",
      y_label = "20 lowest frequencies, rms error [%]"},
    {name = "loads", title = "Local loads that no calibration is fitted to",
      y_label = "compliance, mean error [%]"},
  }
  if wanted.surface then
    charts[#charts + 1] = {name = "surface",
      title = ("Surfaces before the first chaos (%s, up to %.2f s)"):format(name,
        study.surfaces.until_chaos),
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

local function report(study, variants, left_out)
  pareto_tables.save(args.out, variants, left_out, study)
  local x_label = ("cost of a simulated second over the base's (%.3g s by the clock)"):format(
    study.times:base_cost())
  for _, chart in ipairs(charts_of(study)) do
    if wanted[chart.name] then
      chart.x_label = x_label
      local front = pareto_charts.draw(args.out, variants, chart)
      pareto_tables.show_front(args.out, chart, front)
      if chart.name == "surface" then
        pareto_charts.draw_over_time(args.out, front, study.surfaces.floor, chart.title)
      end
    end
  end
  if #left_out > 0 then print(("%d left out: see left-out.csv"):format(#left_out)) end
end

local function pareto()
  local scene, asset = command.load_table(args.scenario), s.load(args.asset)
  local settings, scenario = settings_of(asset), s.scenario(scene) -- wrong ones get into no store
  local study = {
    base = asset[0], size = asset[0].bounds.diagonal, scene = scene, scenario = scenario,
    settings = settings, folder = args.out,
    store = run_store.open(args.out .. "/runs", store_settings(settings, scene)),
  }
  pareto_tables.save_command(args.out .. "/command.txt")
  local measures, left_out = measures_of(study), {}
  report(study, measure_all(study, measures, left_out), left_out)
end

local ok, reason = command.try(pareto)
if not ok then command.fail("pareto of %s: %s", args.asset, reason) end
s.say("wrote " .. args.out)
