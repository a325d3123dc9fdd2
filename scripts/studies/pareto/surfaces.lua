-- Distance between the surfaces of a level and of the base over time, until shortly after the first
-- contact.

local s = require "springlod"
local by_start = require "lib.by_start"
local cut_scene = require "lib.cut_scene"
local pareto_chains = require "studies.pareto.chains"

local pareto_surfaces = {}

-- Comparison ends this long after the first contact [s], as in s.compare: bouncing is chaotic, so
-- later deviations of single runs mean nothing.
local after_contact = 0.25
-- It ends earlier if halving the time step moves the surface of the base by more than this fraction
-- of its size (rms).
local diverged = 0.01
local frame_rate = 60 -- [1/s]
local percent = 100

-- The scene of one jittered start, without a rest criterion.
local function scene_of_start(study, number, duration)
  return s.jittered(cut_scene(study.scene, duration), study.base,
    {number = number, jitter = study.settings.jitter, seed = study.settings.seed})
end

local function run(model, scene, more)
  local options = {frame_rate = frame_rate, ledger = false, quiet = true}
  for key, value in pairs(more or {}) do options[key] = value end
  return s.run(model, scene, options)
end

-- Options with which a run has half the time step of `whole`. Where the duration limits that, a
-- smaller part of the stable step, 0.4 in place of 0.8, may change nothing.
local function half_step(whole)
  return whole.limited_by == "duration" and {step = whole.step / 2} or {safety = 0.4}
end

-- Time up to which one start is comparable [s]: surface_time, or `after_contact` after its first
-- contact; at most the last frame before the base and the base at half the step diverge.
local function comparable_time_of_start(study, start)
  local longest = study.settings.surface_time
  if not longest then
    local contact = run(study.base, scene_of_start(study, start, study.scenario.duration),
      {frame_rate = 0}).first_contact
    longest = contact and contact + after_contact or math.huge
  end
  local scene = scene_of_start(study, start, math.min(longest, study.scenario.duration))
  local whole, last = run(study.base, scene), 0
  for _, d in ipairs(s.deviation(run(study.base, scene, half_step(whole)), whole)) do
    if d.surface > diverged * study.size then break end
    last = d.time
  end
  return last
end

local function start_name(start) return "start-" .. start end

-- The stage that finds the comparable time of each start. `study`: base, size [m], scene, scenario,
-- settings (starts, jitter, seed, surface_time) and seconds(variant), the time of one run.
function pareto_surfaces.times_stage(study, base_variant)
  local units = {}
  for start = 1, study.settings.starts do
    units[start] = {
      name = start_name(start),
      seconds = function() return 3 * study.seconds(base_variant) end,
      make = function()
        local time = comparable_time_of_start(study, start)
        if time < 1 / frame_rate then
          error("surfaces cannot be compared: halving the time step changes the first frame of "
            .. "the base by more than 1 % of its size; check the scene, or remove surface from "
            .. "--errors", 0)
        end
        return {time = time}
      end,
    }
  end
  return {name = "surface-times", columns = {"time"}, units = units, waits = false}
end

-- The shortest comparable time of all starts [s]. need(stage, unit): see lib/study.lua.
local function comparable_time(study, need)
  local first = math.huge
  for start = 1, study.settings.starts do
    first = math.min(first, need("surface-times", start_name(start))[1].time)
  end
  return first
end

-- The run of the base from a start; neighbouring units use the same.
local latest = {}
local function reference_of(study, start, time)
  if latest.start ~= start then
    latest = {start = start, run = run(study.base, scene_of_start(study, start, time))}
  end
  return latest.run
end

local function column(seed) return "seed_" .. seed end

local function unit_name(start, variant)
  return ("%s/%s"):format(start_name(start), variant.name)
end

-- The base at half the step, whose error is the floor.
local half_step_variant = {name = "half-step", making = {}, level = 0}

-- One row per frame: the time and, for each seed, the distance in percent of the size of the base.
local function frames_of(study, start, variant, folder, earlier)
  local time, frames = comparable_time(study, earlier), {}
  local reference = reference_of(study, start, time)
  local options = variant == half_step_variant and half_step(reference) or variant.step_options
  for seed = 1, pareto_chains.count(study, variant.making) do
    local level = run(pareto_chains.level(study, folder, variant, seed, earlier),
      scene_of_start(study, start, time), options)
    for i, d in ipairs(s.deviation(level, reference)) do
      frames[i] = frames[i] or {time = d.time}
      frames[i][column(seed)] = percent * d.surface / study.size
    end
  end
  return frames
end

-- The stage of all comparisons: a unit is a variant from a start.
function pareto_surfaces.stage(study, variants)
  local units = {}
  local function add(start, variant, seconds)
    units[#units + 1] = {
      name = unit_name(start, variant), seconds = seconds,
      make = function(folder, earlier)
        return frames_of(study, start, variant, folder, earlier)
      end,
    }
  end
  local part = 0.5 -- of the scene's duration, in which surfaces are compared, about
  for start = 1, study.settings.starts do
    add(start, half_step_variant, function() return study.seconds(variants[1]) end)
    for _, variant in ipairs(variants) do
      add(start, variant, function()
        return part * pareto_chains.count(study, variant.making) * study.seconds(variant)
      end)
    end
  end
  local columns = {"time"}
  for seed = 1, study.settings.seeds do columns[seed + 1] = column(seed) end
  return {name = "surface", columns = columns, units = units}
end

local Surfaces = {}
Surfaces.__index = Surfaces

-- `time`: up to which surfaces are compared [s]; `floor`: the error of the base at half the step,
-- in the form of error_of. nil and the reason if one is missing.
function pareto_surfaces.read(study, results)
  local surfaces = setmetatable({study = study, results = results}, Surfaces)
  local reason
  surfaces.floor, reason = surfaces:error_of(half_step_variant)
  if not surfaces.floor then return nil, reason end
  surfaces.time = comparable_time(study, function(...) return results:need(...) end)
  return surfaces
end

-- The mean over the frames with its interval over starts and seeds, and the mean over starts and
-- seeds as a function of time (`curve`); nil and the reason if a result is missing.
function Surfaces:error_of(variant)
  local starts, seeds = self.study.settings.starts, pareto_chains.count(self.study, variant.making)
  local means, curve = {}, {}
  for seed = 1, seeds do means[seed] = {} end
  for start = 1, starts do
    local rows, reason = self.results:rows("surface", unit_name(start, variant))
    if not rows then return nil, reason end
    for seed = 1, seeds do
      local sum = 0
      for i, row in ipairs(rows) do
        local value = row[column(seed)]
        sum = sum + value
        curve[i] = curve[i] or {row.time, 0}
        curve[i][2] = curve[i][2] + value / (starts * seeds)
      end
      means[seed][start] = sum / #rows
    end
  end
  local m = s.statistics(by_start(means))
  return {value = m.mean, low = m.mean_low, high = m.mean_high, curve = curve}
end

return pareto_surfaces
