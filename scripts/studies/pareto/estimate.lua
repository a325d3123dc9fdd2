-- Processor time of springlod pareto, estimated from short runs of the base.

local noise_samples = require "lib.noise_samples"
local pareto_variants = require "studies.pareto.variants"
local run_estimate = require "lib.run_estimate"

local cores = 2 -- of the times of fits
local surface_part = 0.5 -- of the scene's duration, in which surfaces are compared
local timed_seconds = 0.2 -- of one repeat of the timed runs, base and level

-- Runs of the base over the scene's duration that come before the variants.
local function base_runs(settings, wanted)
  local runs = 0
  if wanted.ensemble then
    runs = settings.starts
    for _, source in ipairs(noise_samples(settings.starts)) do
      runs = runs + source.options.starts * (source.options.safety and 2 or 1) -- half the step
    end
  end
  -- The first contact, then the comparison of the base with itself at half the step.
  return runs + (wanted.surface and settings.starts * (1 + 3 * surface_part) or 0)
end

-- Processor time of all levels and runs [s], without those that are kept. `study`: base, scene,
-- scenario and settings. `wanted`: the errors. fit_time(base): the time of one fit.
return function(study, axes, wanted, fit_time)
  local settings, duration = study.settings, study.scenario.duration
  local found = {}
  -- Of one run of the base; what cannot be run fails at once.
  local function time_of(stepping)
    if not found[stepping.name] then
      local variant = pareto_variants.variant({name = "base"}, 0, stepping, settings.implicit_step)
      found[stepping.name] = (run_estimate.of(study.base, study.scene, variant.step_options) or 0)
        * duration
    end
    return found[stepping.name]
  end
  local of_base = (run_estimate.of(study.base, study.scene, {}) or 0) * duration
  local total = base_runs(settings, wanted) * of_base
  -- Runs of one variant and one seed.
  local runs = (wanted.ensemble and settings.starts or 0)
    + (wanted.surface and settings.starts * surface_part or 0)
  for _, making in ipairs(pareto_variants.methods(axes)) do
    local seeds = making.grouping and settings.seeds or 1
    if making.calibration == "modes" then
      total = total + seeds * cores * fit_time(study.base)
    end
    for _, stepping in ipairs(pareto_variants.steppings(axes, making)) do
      -- A run of a level costs about its share of the nodes.
      for _, share in ipairs(making.grouping and settings.keep or {1}) do
        total = total + seeds * runs * share * time_of(stepping)
          + settings.repeats * timed_seconds
      end
    end
  end
  return total
end
