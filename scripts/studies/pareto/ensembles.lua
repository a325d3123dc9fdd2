-- Compares the distribution of final distances of a level with that of the base, and with the noise
-- floor of the base.

local s = require "springlod"
local intervals = require "lib.intervals"
local lists = require "lib.lists"
local noise_samples = require "lib.noise_samples"
local pareto_chains = require "studies.pareto.chains"

local pareto_ensembles = {}

local columns = {"start", "distance", "simulated", "spring_updates", "first_crossing"}

local function name_of(variant, number) return ("%s-seed-%d"):format(variant.name, number) end

local function rows_of(study, model, more)
  local options = {jitter = study.settings.jitter, seed = study.settings.seed,
                   starts = study.settings.starts}
  for key, value in pairs(more) do options[key] = value end
  return lists.with_fields(s.ensemble(model, study.scenario, options), columns)
end

-- The stage of all ensembles. `study`: base, scenario, settings (starts, jitter, seed) and
-- seconds(variant), the time of one run.
function pareto_ensembles.stage(study, variants)
  local units = {}
  local function add(name, seconds, make)
    units[#units + 1] = {name = name, seconds = seconds, make = make}
  end
  local function of_base(name, options)
    add(name, function()
      return (options.starts or study.settings.starts) * study.seconds(variants[1])
    end, function() return rows_of(study, study.base, options) end)
  end
  of_base("base", {})
  for _, source in ipairs(noise_samples(study.settings.starts)) do
    of_base(source.name, source.options)
  end
  for _, variant in ipairs(variants) do
    for number = 1, pareto_chains.count(study, variant.making) do
      add(name_of(variant, number), function()
        return study.settings.starts * study.seconds(variant)
      end, function(folder, earlier)
        return rows_of(study, pareto_chains.level(study, folder, variant, number, earlier),
          variant.step_options)
      end)
    end
  end
  return {name = "ensemble", columns = columns, units = units, waits = false}
end

local Ensembles = {}
Ensembles.__index = Ensembles

local function distances(results, name)
  local rows, reason = results:rows("ensemble", name)
  if not rows then return nil, reason end
  local list = {}
  for i, row in ipairs(rows) do list[i] = row.distance end
  return list
end

-- The sample of the base and its noise floor, the field `floor`; nil and the reason if one is
-- missing.
function pareto_ensembles.read(study, results)
  local base, reason = distances(results, "base")
  if not base then return nil, reason end
  local noise = {}
  for i, source in ipairs(noise_samples(study.settings.starts)) do
    noise[i], reason = distances(results, source.name)
    if not noise[i] then return nil, reason end
  end
  return setmetatable({
    study = study, results = results, base = base,
    floor = s.noise_floor(noise, {size = study.settings.starts}),
  }, Ensembles)
end

local function root_of_squares(a, b) return math.sqrt(a ^ 2 + b ^ 2) end

-- Wasserstein distance to the sample of the base, mean over the seeds, and the number of seeds
-- inside the noise floor; nil and the reason if a sample is missing. Seeds are not pooled: the
-- floor holds for samples of its size, and larger samples have smaller distances. The uncertainties
-- from starts and from seeds add in quadrature.
function Ensembles:error_of(variant)
  local values, below, above, inside = {}, 0, 0, 0
  local count = pareto_chains.count(self.study, variant.making)
  for number = 1, count do
    local found, reason = distances(self.results, name_of(variant, number))
    if not found then return nil, reason end
    if self.floor:judge(self.base, found).inside then inside = inside + 1 end
    local w = s.compare_samples(self.base, found, {paired = true}).wasserstein
    values[number] = w.value
    below = below + math.max(0, w.value - w.low) / count
    above = above + math.max(0, w.high - w.value) / count
  end
  local m = intervals.mean(values)
  return {value = m.value, low = math.max(0, m.value - root_of_squares(below, m.value - m.low)),
          high = m.value + root_of_squares(above, m.high - m.value), inside = inside}
end

return pareto_ensembles
