-- Compares the distribution of final distances of a level with that of the base, and with the noise
-- floor of the base.

local s = require "springlod"
local intervals = require "lib.intervals"
local noise_samples = require "lib.noise_samples"

local pareto_ensembles = {}

local Ensembles = {}
Ensembles.__index = Ensembles

local columns = {"start", "distance", "simulated", "spring_updates", "first_crossing"}

local function distances(study, name, model, more)
  local options = {jitter = study.settings.jitter, seed = study.settings.seed,
                   starts = study.settings.starts}
  for key, value in pairs(more) do options[key] = value end
  local list = {}
  for i, row in ipairs(study.store:rows("ensemble/" .. name, columns, function()
    return s.ensemble(model, study.scenario, options)
  end)) do
    list[i] = row.distance
  end
  return list
end

-- `study`: base, scenario, settings (starts, jitter, seed), store. `floor`: a NoiseFloor.
function pareto_ensembles.new(study)
  local noise = {}
  for i, source in ipairs(noise_samples(study.settings.starts)) do
    noise[i] = distances(study, source.name, study.base, source.options)
  end
  return setmetatable({
    study = study, base = distances(study, "base", study.base, {}),
    floor = s.noise_floor(noise, {size = study.settings.starts}),
  }, Ensembles)
end

local function root_of_squares(a, b) return math.sqrt(a ^ 2 + b ^ 2) end

-- Wasserstein distance to the sample of the base, mean over the seeds, and the number of seeds
-- inside the noise floor. Seeds are not pooled: the floor holds for samples of its size, and larger
-- samples have smaller distances. The uncertainties from starts and from seeds add in quadrature.
function Ensembles:error_of(variant, chains)
  local values, below, above, inside = {}, 0, 0, 0
  for i, chain in ipairs(chains) do
    local found = distances(self.study, ("%s-seed-%d"):format(variant.name, i),
      chain[variant.level], variant.step_options)
    if self.floor:judge(self.base, found).inside then inside = inside + 1 end
    local w = s.compare_samples(self.base, found, {paired = true}).wasserstein
    values[i] = w.value
    below = below + math.max(0, w.value - w.low) / #chains
    above = above + math.max(0, w.high - w.value) / #chains
  end
  local m = intervals.mean(values)
  return {value = m.value, low = math.max(0, m.value - root_of_squares(below, m.value - m.low)),
          high = m.value + root_of_squares(above, m.high - m.value), inside = inside}
end

return pareto_ensembles
