-- The two tables of the paper, computed from samples of many runs (studies/paper/runs.lua), with
-- confidence intervals, noise floor and equivalence tests.

local s = require "springlod"
local by_start = require "lib.by_start"
local paper_numbers = require "studies.paper.numbers"
local paper_runs = require "studies.paper.runs"
local paper_variants = require "studies.paper.variants"

local mean = s.mean

local paper_tables = {}

paper_tables.columns = {
  "case", "model", "nodes", "ends", "paper_nodes", "paper_ends",
  "distance", "distance_low", "distance_high", "spread",
  "difference", "difference_low", "difference_high",
  "over_spread", "over_spread_low", "over_spread_high",
  "wasserstein", "wasserstein_low", "wasserstein_high",
  "noise_floor", "seeds_inside", "seeds", "equivalent", "turned_over_percent",
  "paper_distance", "paper_difference",
}

-- Node and end counts of a level, means over the seeds.
local function counts(one, variant, level, settings, results)
  local function mean_of(field)
    return math.floor(mean(paper_runs.by_seed(settings, function(seed)
      local rows = results:rows("levels", paper_runs.chain_name(one, variant, seed))
      return rows and rows[level][field]
    end)) + 0.5)
  end
  return mean_of("nodes"), mean_of("ends")
end

local function base_row(one)
  local m = s.statistics(one.base_distances)
  return {
    case = one.name, model = "base", nodes = one.base.node_count, ends = one.base.end_count,
    distance = m.mean, distance_low = m.mean_low, distance_high = m.mean_high,
    spread = m.deviation,
    turned_over_percent = 100 * one.turned_over.base / #one.base_distances,
  }
end

local function level_row(one, variant, level, floor, settings, results)
  local label = paper_variants.label(variant.name, level)
  local seeds = one.levels[label]
  local c = s.compare_samples(one.base_distances, by_start(seeds),
    {paired = true, margin = settings.margin})
  local m = s.statistics(by_start(seeds))
  local inside = 0
  for _, distances in ipairs(seeds) do
    if floor:judge(one.base_distances, distances).inside then inside = inside + 1 end
  end
  local nodes, ends = counts(one, variant, level, settings, results)
  return {
    case = one.name, model = label, nodes = nodes, ends = ends,
    distance = m.mean, distance_low = m.mean_low, distance_high = m.mean_high,
    spread = m.deviation,
    difference = c.difference.value, difference_low = c.difference.low,
    difference_high = c.difference.high,
    over_spread = c.difference_over_spread.value, over_spread_low = c.difference_over_spread.low,
    over_spread_high = c.difference_over_spread.high,
    wasserstein = c.wasserstein.value, wasserstein_low = c.wasserstein.low,
    wasserstein_high = c.wasserstein.high,
    noise_floor = floor.level, seeds_inside = inside, seeds = #seeds,
    equivalent = c.equivalent and "yes" or "not shown",
    turned_over_percent = 100 * one.turned_over[label] / (#seeds * #seeds[1]),
  }
end

local function with_paper_values(row, one)
  local counted
  if one.speed then counted = paper_numbers.rods[row.model]
  else counted = paper_numbers.roll[row.model] end
  if not counted then return row end -- not a variant of the paper
  row.paper_nodes, row.paper_ends = counted.nodes, counted.ends
  if one.speed then
    local theirs = paper_numbers.at(row.model, one.speed)
    local base = paper_numbers.at("base", one.speed)
    if theirs then
      row.paper_distance, row.paper_difference = theirs[1], theirs[1] - base[1]
    end
  else
    row.paper_distance = counted.distance
    row.paper_difference = counted.distance - paper_numbers.roll.base.distance
  end
  return row
end

-- The rows of one case: the base, then the levels of every variant that has results.
function paper_tables.rows(one, settings, results)
  local floor = s.noise_floor(one.noise, {size = #one.base_distances})
  local rows = {with_paper_values(base_row(one), one)}
  paper_runs.each_level(one, function(label, variant, level)
    if one.levels[label] then
      rows[#rows + 1] = with_paper_values(
        level_row(one, variant, level, floor, settings, results), one)
    end
  end)
  return rows
end

-- Counts over all rows of a model: simplifications (seeds) inside the noise floor, simplifications,
-- and rows whose pooled sample is inside the noise floor.
local function inside_floor(model, all)
  local inside, seeds, pooled = 0, 0, 0
  for _, row in ipairs(all) do
    if row.model == model then
      inside, seeds = inside + row.seeds_inside, seeds + row.seeds
      if row.wasserstein <= row.noise_floor then pooled = pooled + 1 end
    end
  end
  return inside, seeds, pooled
end

-- Table 2 summarized over the speeds, one row per model: mean |difference of the means| from the
-- base, absolute and relative to the spread of the base, the paper's value, and the counts of
-- inside_floor. The first row compares the base with itself at other starts. `all`: the rows of all
-- speeds.
function paper_tables.over_speeds(cases, all)
  local rows, spread = {}, {}
  for _, row in ipairs(all) do
    if row.model == "base" then spread[row.case] = row.spread end
  end
  local other, other_spreads = {}, {}
  for i, one in ipairs(cases) do
    other[i] = math.abs(mean(one.noise[1]) - mean(one.base_distances))
    other_spreads[i] = other[i] / spread[one.name]
  end
  rows[1] = {
    model = "base, other starts", mean_difference = mean(other),
    mean_over_spread = mean(other_spreads),
  }
  paper_runs.each_level(cases[1], function(label)
    local ours, spreads, theirs = {}, {}, {}
    for _, one in ipairs(cases) do
      if not one.levels[label] then goto continue end
      local seeds = {}
      for _, distances in ipairs(one.levels[label]) do seeds[#seeds + 1] = mean(distances) end
      ours[#ours + 1] = math.abs(mean(seeds) - mean(one.base_distances))
      spreads[#spreads + 1] = ours[#ours] / spread[one.name]
      local paper = paper_numbers.at(label, one.speed)
      if paper then
        theirs[#theirs + 1] = math.abs(paper[1] - paper_numbers.at("base", one.speed)[1])
      end
      ::continue::
    end
    if #ours == 0 then return end
    local inside, seed_count, pooled = inside_floor(label, all)
    rows[#rows + 1] = {
      model = label, mean_difference = mean(ours), mean_over_spread = mean(spreads),
      seeds_inside = inside, seeds = seed_count, speeds_inside = pooled,
      paper_mean_difference = #theirs > 0 and mean(theirs) or nil,
    }
  end)
  return rows, {
    "model", "mean_difference", "mean_over_spread", "seeds_inside", "seeds",
    "speeds_inside", "paper_mean_difference",
  }
end

-- The table for readers: each value and its interval in one cell.
function paper_tables.readable(rows)
  local short = {}
  for i, row in ipairs(rows) do
    local function interval(name)
      if not row[name] then return "" end
      local value, low, high = row[name], row[name .. "_low"], row[name .. "_high"]
      if low ~= low or high ~= high then return ("%.2f (no interval)"):format(value) end -- NaN
      return ("%.2f (%.2f .. %.2f)"):format(value, low, high)
    end
    local function difference(value) return value and ("%+.1f"):format(value) or "" end
    short[i] = {
      row.model, ("%d/%d"):format(row.nodes, row.ends),
      row.paper_nodes and ("%d/%d"):format(row.paper_nodes, row.paper_ends) or "",
      interval("distance"),
      ("%.2f"):format(row.spread), interval("over_spread"), interval("wasserstein"),
      row.noise_floor and ("%.2f"):format(row.noise_floor) or "",
      row.seeds and ("%d of %d"):format(row.seeds_inside, row.seeds) or "", row.equivalent or "",
      ("%.0f %%"):format(row.turned_over_percent), difference(row.difference),
      difference(row.paper_difference),
    }
  end
  return short, {
    "model", "nodes/ends", "paper", "distance [m]", "spread [m]", "difference/spread", "W1 [m]",
    "floor [m]", "inside", "same", "turned", "difference [m]", "paper's",
  }
end

return paper_tables
