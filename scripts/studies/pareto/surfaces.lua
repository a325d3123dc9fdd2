-- Distance between the surfaces of a level and of the base over time, until shortly after the first
-- contact.

local s = require "springlod"
local by_start = require "lib.by_start"
local cut_scene = require "lib.cut_scene"

local pareto_surfaces = {}

local Surfaces = {}
Surfaces.__index = Surfaces

-- Comparison ends this long after the first contact [s], as in s.compare: bouncing is chaotic, so
-- later deviations of single runs mean nothing.
local after_contact = 0.25
-- It ends earlier if halving the time step moves the surface of the base by more than this fraction
-- of its size (rms).
local diverged = 0.01
local half_step = {safety = 0.4} -- fraction of the predicted stable step; runs use 0.8
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
  local last = 0
  for _, d in ipairs(s.deviation(run(study.base, scene, half_step), run(study.base, scene))) do
    if d.surface > diverged * study.size then break end
    last = d.time
  end
  return last
end

-- The shortest comparable time of all starts [s].
local function comparable_time(study)
  local rows = study.store:rows("chaos", {"start", "time"}, function()
    local found = {}
    for start = 1, study.settings.starts do
      found[start] = {start = start, time = comparable_time_of_start(study, start)}
    end
    return found
  end)
  local first = math.huge
  for _, row in ipairs(rows) do first = math.min(first, row.time) end
  if first < 1 / frame_rate then
    error("surfaces cannot be compared: halving the time step changes the first frame of the "
      .. "base by more than 1 % of its size; check the scene, or remove surface from --errors", 0)
  end
  return first
end

-- `study`: base, size [m], scene, scenario, settings (starts, jitter, seed, surface_time) and
-- store. The field `floor` is the error of the base at half the step, in the form of error_of.
function pareto_surfaces.new(study)
  local surfaces = setmetatable({study = study, time = comparable_time(study)}, Surfaces)
  surfaces.floor = surfaces:summary{surfaces:rows("half-step", study.base, half_step)}
  return surfaces
end

-- The runs of the base, one per start.
function Surfaces:references()
  if not self.base_runs then
    self.base_runs = {}
    for start = 1, self.study.settings.starts do
      self.base_runs[start] = run(self.study.base,
        scene_of_start(self.study, start, self.time))
    end
  end
  return self.base_runs
end

local function column(start) return "start_" .. start end

-- One row per frame: the time and, for each start, the distance in percent of the size of the base.
function Surfaces:rows(name, model, options)
  local columns = {"time"}
  for start = 1, self.study.settings.starts do columns[start + 1] = column(start) end
  return self.study.store:rows("surface/" .. name, columns, function()
    local frames = {}
    for start, reference in ipairs(self:references()) do
      local level = run(model, scene_of_start(self.study, start, self.time), options)
      for i, d in ipairs(s.deviation(level, reference)) do
        frames[i] = frames[i] or {d.time}
        frames[i][start + 1] = percent * d.surface / self.study.size
      end
    end
    return frames
  end)
end

-- `seeds`: one list of rows per seed. Returns the mean over the frames with its interval over
-- starts and seeds, and the mean over starts and seeds as a function of time (`curve`).
function Surfaces:summary(seeds)
  local starts, means, curve = self.study.settings.starts, {}, {}
  for i, row in ipairs(seeds[1]) do curve[i] = {row.time, 0} end
  for seed, rows in ipairs(seeds) do
    means[seed] = {}
    for start = 1, starts do
      local sum = 0
      for i, row in ipairs(rows) do
        sum = sum + row[column(start)]
        curve[i][2] = curve[i][2] + row[column(start)] / (starts * #seeds)
      end
      means[seed][start] = sum / #rows
    end
  end
  local m = s.statistics(by_start(means))
  return {value = m.mean, low = m.mean_low, high = m.mean_high, curve = curve}
end

function Surfaces:error_of(variant, chains)
  local seeds = {}
  for i, chain in ipairs(chains) do
    seeds[i] = self:rows(("%s-seed-%d"):format(variant.name, i), chain[variant.level],
      variant.step_options)
  end
  return self:summary(seeds)
end

return pareto_surfaces
