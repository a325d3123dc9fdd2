-- Processor time of a stability map, estimated from short runs of its models.

local s = require "springlod"
local run_estimate = require "lib.run_estimate"

local least_steps = 200 -- of an explicit run, as in s.stability
-- Steps of the two reference runs: a quarter and half of the stable one.
local references = 4 + 2

-- Ratio of Young's moduli that the model was made with.
local function ratio_of(model)
  local low, high = math.huge, 0
  for _, material in ipairs(model.materials) do
    low, high = math.min(low, material.young), math.max(high, material.young)
  end
  return high > 0 and high / low or 1
end

-- Steps of the runs of an explicit integrator. `stable`: the number of stable steps. Runs of longer
-- steps diverge soon.
local function explicit_steps(fractions, stable)
  local count = 0
  for _, fraction in ipairs(fractions) do
    count = count + (fraction <= 1 and math.max(stable / fraction, least_steps) or least_steps)
  end
  return count
end

local function implicit_steps(fractions, periods)
  local count = 0
  for _, fraction in ipairs(fractions) do count = count + math.max(1, periods / fraction) end
  return count
end

-- `options`: integrators, iterations, steps, implicit_steps, sweep_steps, periods and duration, as
-- for s.stability; all but duration must be there. Returns a function of a level and a ratio: the
-- processor time of its runs [s].
return function(asset, options)
  local modes = s.modes(asset[0], {count = 1})
  if #modes == 0 then return function() return 0 end end
  local period = 1 / modes[1].frequency
  local duration = options.duration or options.periods * period
  local scene = {gravity = {0, 0, 0}, duration = duration,
                 throw = {velocity = {0, 0, 0}, spin = {0.2 / period, 0.1 / period, 0}}}
  local known = {} -- times of steps of a level
  local function time_of(level, integrator, of_step, iterations)
    local key = ("%d %s %g %d"):format(level, integrator, of_step, iterations or 0)
    known[key] = known[key] or (run_estimate.of(asset[level], scene,
      {integrator = integrator, step = of_step, iterations = iterations}) or 0)
    return known[key] * of_step -- of one step
  end
  return function(level, ratio)
    local step = s.stable_step(asset[level])
    -- The stable step changes with the square root of the ratio. Softer materials limit it too.
    local stable = math.sqrt(math.max(ratio, 1) / ratio_of(asset[0])) * duration / step
    local total = references * stable * time_of(level, "velocity_verlet", 0.5 * step)
    for _, integrator in ipairs(options.integrators) do
      local traits = s.choices.integrator[integrator]
      if not traits.implicit then
        total = total
          + time_of(level, integrator, 0.5 * step) * explicit_steps(options.steps, stable)
      else
        local fractions = traits.swept and options.sweep_steps or options.implicit_steps
        local count = implicit_steps(fractions, duration / period)
        for _, iterations in ipairs(traits.swept and options.iterations or {0}) do
          total = total + count * time_of(level, integrator, fractions[#fractions] * period,
            iterations > 0 and iterations or nil)
        end
      end
    end
    return total
  end
end
