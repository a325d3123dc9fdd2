-- Measure the accuracy of levels by method: groupings, calibration and refilling.

local s = require "springlod"
local command = require "lib.command"
local bodies = require "studies.accuracy.bodies"
local conversion = require "lib.conversion"
local intervals = require "lib.intervals"
local lists = require "lib.lists"
local show = require "lib.show"
local split_table = require "lib.split_table"
local study = require "lib.study"
local timed_run = require "lib.timed_run"
local trade_off = require "studies.accuracy.trade_off"

local methods = {
  {name = "plain merging", options = {grouping = "standard"}},
  {name = "moduli", options = {grouping = "standard", calibrate = "moduli"}},
  {name = "calibrated", options = {grouping = "standard", calibrate = "modes"}},
  {name = "compact plain", options = {grouping = "compact"}},
  {name = "compact calibrated", options = {grouping = "compact", calibrate = "modes"}},
  {name = "compact pieces", options = {
    grouping = "compact", calibrate = "modes", calibration = {masses = "free", moments = "pieces"},
  }},
  {name = "METIS plain", options = {grouping = "metis"}},
  {name = "METIS calibrated", options = {grouping = "metis", calibrate = "modes"}},
  {name = "random refill", refill = "random"},
  {name = "lattice refill", refill = "lattice"},
}

local parser = command.parser("accuracy", "Measure the accuracy of levels with 45 % and 20 % of "
  .. "the nodes of their base: merged by several groupings, calibrated, and refilled. Writes "
  .. "levels.csv (every level) and methods.csv (means over bodies and seeds, and the worst body), "
  .. "and prints the latter; models/ has the levels as assets.")
command.add_out(parser, "out/accuracy", "folder", true)
parser:option("--seeds", "number of seeds for each body and method"):default("5")
  :convert(command.whole("--seeds", 1))
local function some_of(option, list)
  local names = lists.names_of(list)
  parser:option(option, "any of " .. table.concat(names, ", "))
    :convert(command.words_of(option, names)):default(table.concat(names, ","))
end
some_of("--bodies", bodies)
some_of("--methods", methods)
parser:flag("--trade-off", "measure compact groups only, plain and calibrated, with 80 % to 10 % "
  .. "of the nodes, and draw error against cost reduction (trade-off.svg and .png)")
parser:flag("--quick", "use one seed of one small body; takes seconds")
local args = parser:parse()

local keep = args.trade_off and trade_off.keep or {0.45, 0.2}
if args.trade_off then args.methods = trade_off.methods end
local seeds = args.quick and 1 or args.seeds
if args.quick then args.bodies = {"sphere"} end

local function make_chain(body, method, seed)
  if method.refill then
    local counts = {}
    for i, share in ipairs(keep) do
      counts[i] = math.floor(share * body.base.node_count + 0.5)
    end
    return s.certify(s.refill(body.base, body.grid,
      {nodes = counts, style = method.refill, lattice = body.lattice, seed = seed}))
  end
  local options = {keep = keep, seed = seed}
  for name, value in pairs(method.options) do options[name] = value end
  local chain = s.simplify(body.base, options)
  if options.calibrate ~= "modes" then chain = s.certify(chain) end
  return chain
end

-- The columns that describe a level; errors in percent. Those without a function are measured by
-- the clock, with a layout of s.run: "any shape" for both models, or the "fastest" for each, which
-- for a lattice is a different one.
local measures = {
  {"f1..10", function(c) return 100 * c.f1_10_error end},
  {"f11..20", function(c) return 100 * c.f11_20_error end},
  {"smooth loads", function(c) return 100 * c.fitted_load_error end},
  {"held-out loads", function(c) return 100 * c.held_out_load_error end},
  {"omega/base", function(c) return c.highest_frequency / c.base_highest_frequency end},
  {"base cost/cost", function(c) return c.base_cost / c.cost end},
  {"same kernel", layout = "any shape"},
  {"fastest kernel", layout = "fastest"},
  {"second moments", function(c) return 100 * c.second_moment_error end},
  {"mechanisms", function(c) return c.zero_modes > c.expected_zero_modes and 1 or 0 end},
}
-- For these columns the smallest value is the worst.
local more_is_better = {
  ["base cost/cost"] = true, ["same kernel"] = true, ["fastest kernel"] = true,
}

local level_columns = {"body", "method", "seed", "level", "nodes", "base nodes"}
local method_columns = {"level", "method", "levels"}
for _, measure in ipairs(measures) do
  level_columns[#level_columns + 1] = measure[1]
  method_columns[#method_columns + 1] = measure[1]
end
for _, measure in ipairs(measures) do
  method_columns[#method_columns + 1] = measure[1] .. " worst"
end

local rows, samples = {}, {}

local function sample_of(level, method)
  local key = level .. " " .. method.name
  samples[key] = samples[key] or {level = level, method = method.name, by_body = {}}
  return samples[key]
end

-- What a unit is about; one process measures the units of a body one after another.
local current = {}
local function made(body)
  if current.body ~= body then
    local base, grid, lattice = body.make()
    current = {body = body, base = base, grid = grid, lattice = lattice}
  end
  return current
end

local function unit_name(body, method, seed)
  return ("%s, %s, seed %d"):format(body.name, method.name, seed)
end

local function model_path(folder, name)
  return ("%s/models/%s.glb"):format(folder, (name:gsub("[ ,]+", "-")))
end

local level_measures, times = {}, {} -- names
for _, measure in ipairs(measures) do
  table.insert(measure.layout and times or level_measures, measure[1])
end

-- Makes the levels of a method, which it saves, and reads their certificates.
local function certified_levels(body, method, seed, folder)
  local found = {}
  local chain = make_chain(made(body), method, seed)
  for number, level in ipairs(s.info(chain).levels) do
    local certificate = level.certificate
    if certificate then
      local row = {level = number - 1, nodes = level.nodes, base_nodes = chain[0].node_count}
      for _, measure in ipairs(measures) do
        if measure[2] then row[measure[1]] = measure[2](certificate) end
      end
      found[#found + 1] = row
    end
  end
  s.save(model_path(folder, unit_name(body, method, seed)), chain)
  return found
end

-- Speedup over the base in wall-clock time per simulated second, each at its own stable step, timed
-- alternately on a free-floating body. `scene`: lasts about least_seconds with the base.
local least_seconds = 0.02
local function speedup(base, model, scene, layout)
  local turns, how = 3, {layout = layout}
  local ratios = {}
  for turn = 1, turns do
    ratios[turn] = timed_run.long(base, scene, how, least_seconds)
      / timed_run.long(model, scene, how, least_seconds)
  end
  return intervals.median(ratios).value
end

local function timed_levels(name, folder, levels)
  local found = {}
  local chain = s.load(model_path(folder, name))
  local scene = {duration = least_seconds / timed_run.once(chain[0], {duration = 0.1})}
  for i, level in ipairs(levels) do
    found[i] = {level = level.level}
    for _, measure in ipairs(measures) do
      if measure.layout then
        found[i][measure[1]] = speedup(chain[0], chain[level.level], scene, measure.layout)
      end
    end
  end
  return found
end

local function wanted(list, one)
  for _, name in ipairs(list) do
    if name == one.name then return true end
  end
  return false
end

-- Calls visit(body, method, seed, name of the unit) for all that is measured.
local function each(visit)
  for _, body in ipairs(bodies) do
    for _, method in ipairs(methods) do
      local both = wanted(args.bodies, body) and wanted(args.methods, method)
      local count = method.refill == "lattice" and 1 or seeds -- it does not depend on the seed
      for seed = 1, both and count or 0 do
        visit(body, method, seed, unit_name(body, method, seed))
      end
    end
  end
end

local timed_seconds = 1.5 -- of the timed runs of a unit: two levels, two layouts

local function describe()
  local levels, timed = {}, {}
  each(function(body, method, seed, name)
    levels[#levels + 1] = {
      name = name, seconds = function() return conversion.fit_time(made(body).base) end,
      make = function(folder) return certified_levels(body, method, seed, folder) end,
    }
    timed[#timed + 1] = {name = name, seconds = timed_seconds, make = function(folder, earlier)
      return timed_levels(name, folder, earlier("levels", name))
    end}
  end)
  return {
    {name = "levels", units = levels,
     columns = {"level", "nodes", "base_nodes", table.unpack(level_measures)}},
    {name = "times", units = timed, alone = true, columns = {"level", table.unpack(times)},
     timings = times},
  }
end

local function note(body, method, seed, levels, timed)
  for i, level in ipairs(levels) do
    local values = {}
    for k, measure in ipairs(measures) do
      values[k] = (measure.layout and timed[i] or level)[measure[1]]
    end
    local row = {body.name, method.name, seed, level.level, level.nodes, level.base_nodes}
    table.move(values, 1, #values, #row + 1, row)
    rows[#rows + 1] = row
    local of_body = sample_of(level.level, method).by_body
    of_body[body.name] = of_body[body.name] or {}
    table.insert(of_body[body.name], values)
  end
end

local function mean(list, i)
  local sum = 0
  for _, values in ipairs(list) do sum = sum + values[i] end
  return sum / #list
end

-- Mean over the means of the bodies, and the worst of these means.
local function summary(sample)
  local means, worst, levels, count = {}, {}, 0, 0
  for _, list in pairs(sample.by_body) do
    levels, count = levels + #list, count + 1
    for i, measure in ipairs(measures) do
      local value = mean(list, i)
      means[i] = (means[i] or 0) + value
      local pick = more_is_better[measure[1]] and math.min or math.max
      worst[i] = worst[i] and pick(worst[i], value) or value
    end
  end
  for i = 1, #means do means[i] = means[i] / count end
  return means, worst, levels
end

local function summary_rows()
  local all = {}
  for level = 1, #keep do
    for _, method in ipairs(methods) do
      local sample = samples[level .. " " .. method.name]
      if sample then
        local means, worst, levels = summary(sample)
        local row = {level, method.name, levels}
        table.move(means, 1, #means, #row + 1, row)
        table.move(worst, 1, #worst, #row + 1, row)
        all[#all + 1] = row
      end
    end
  end
  return all
end

-- What is not an error, as a ratio or a share of the levels.
local text_of = {
  ["omega/base"] = show.full, ["base cost/cost"] = show.full, ["same kernel"] = show.full,
  ["fastest kernel"] = show.full,
  mechanisms = function(share) return ("%.0f %%"):format(100 * share) end,
}

local meanings = [[
Means over bodies and seeds%s; errors in percent. Level 1 has 45 %%, level 2 20 %% of the nodes.
f1..10, f11..20: natural frequencies; loads: compliance under smooth loads, and loads that no fit
sees. omega/base: highest frequency over the base's. base cost/cost: spring updates of the base over
those of the level. same kernel, fastest kernel: the same by the clock, with one kernel for both and
with the fastest of each. second moments: of the mass. mechanisms: levels with a motion that needs
no force.]]

local function print_means(all)
  local several, texts, columns = #args.bodies > 1, {}, {"level", "method"}
  for i, row in ipairs(all) do
    texts[i] = {row[1], row[2]}
    for k, measure in ipairs(measures) do
      local as_text = text_of[measure[1]] or function(value) return show.percent(value / 100) end
      local mean_text, worst_text = as_text(row[3 + k]), as_text(row[3 + #measures + k])
      texts[i][k + 2] = several and ("%s (%s)"):format(mean_text, worst_text) or mean_text
    end
  end
  for i, measure in ipairs(measures) do columns[i + 2] = measure[1] end
  print(split_table.format(texts, columns, 2))
  print(meanings:format(several and " (worst body in parentheses)" or ""))
end

-- The index of a measure by its name.
local function index_of(name)
  for i, measure in ipairs(measures) do
    if measure[1] == name then return i end
  end
end

-- `note_of_gaps`: after the title.
local function draw_trade_off(folder, note_of_gaps)
  trade_off.chart(folder .. "/trade-off", function(level, method, measure)
    local sample = samples[level .. " " .. method]
    return sample and (summary(sample))[index_of(measure)]
  end, note_of_gaps)
end

local function report(results, folder)
  each(function(body, method, seed, name)
    local levels, reason = results:rows("levels", name)
    local timed, untimed = results:rows("times", name)
    if levels and timed then
      note(body, method, seed, levels, timed)
    else
      s.say(("%s: left out: %s"):format(name, reason or untimed))
    end
  end)
  s.csv(folder .. "/levels.csv", rows, {columns = level_columns})
  local all = summary_rows()
  s.csv(folder .. "/methods.csv", all, {columns = method_columns})
  print_means(all)
  if args.trade_off then draw_trade_off(folder, results:note()) end
end

return study.run(args, {describe = describe, report = report,
                        hint = "--quick, --bodies, --methods and --seeds shorten it"})
