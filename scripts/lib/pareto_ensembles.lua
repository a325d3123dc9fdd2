-- Where many starts of a level end, against where those of the base do, and how far the base is
-- from itself.

local s = require "springlod"
local by_start = require "lib.by_start"
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

-- Wasserstein distance from the base's sample, with its interval over starts and seeds, and how
-- many seeds are inside the noise floor, each by itself.
function Ensembles:error_of(variant, chains)
  local seeds, inside = {}, 0
  for i, chain in ipairs(chains) do
    seeds[i] = distances(self.study, ("%s-seed-%d"):format(variant.name, i), chain[variant.level],
      variant.step_options)
    if self.floor:judge(self.base, seeds[i]).inside then inside = inside + 1 end
  end
  local w = s.compare_samples(self.base, by_start(seeds), {paired = true}).wasserstein
  return {value = w.value, low = w.low, high = w.high, inside = inside}
end

return pareto_ensembles
