-- The models and runs behind springlod pareto: chains kept as assets, runs and times in a store.
-- What is there is not made again.

local s = require "springlod"
local averages = require "lib.averages"
local body_size = require "lib.body_size"
local by_start = require "lib.by_start"
local cut_scene = require "lib.cut_scene"
local intervals = require "lib.intervals"
local noise_samples = require "lib.noise_samples"

local pareto_runs = {}

local Runs = {}
Runs.__index = Runs

local frequency_count = 20
local percent = 100
-- The base has lost itself, so that no level can be held against it any longer, once half the step
-- moves its nodes by this part of its size (rms).
local chaos = 0.01
local frame_rate = 60 -- of runs whose surfaces are compared [1/s]
local timed_seconds = 0.1 -- that a timed run of the base takes: long beside what timers are off [s]
local patience = 5 -- for the repeats of one variant [s]; beyond it three are enough
local least_repeats = 3

local distance_columns = {"start", "distance", "simulated", "spring_updates", "first_crossing"}

-- `settings`: keep, seeds, starts, jitter, seed, repeats, implicit_step.
function pareto_runs.new(base, scene, settings, folder, store)
  return setmetatable({
    base = base, scene = scene, scenario = s.scenario(scene), size = body_size(base),
    settings = settings, folder = folder, store = store,
  }, Runs)
end

-- 1. Chains.

function Runs:chain_path(making, seed)
  return ("%s/models/%s-seed-%d.glb"):format(self.folder, making.name, seed)
end

-- A strong border may leave more nodes than are asked for; then it gets as many as it makes.
local function simplify(base, making, settings, seed)
  local options = {grouping = making.grouping, border = making.border,
                   calibrate = making.calibration, seed = seed, keep = settings.keep}
  local ok, chain = pcall(s.simplify, base, options)
  if not ok and making.border == "strong" and chain.kind == "input" then
    options.keep, options.levels = nil, #settings.keep
    chain = s.simplify(base, options)
  elseif not ok then
    error(chain, 0)
  end
  return making.calibration == "modes" and chain or s.certify(chain)
end

-- The chain of one seed, with certificates; the base alone has none.
function Runs:chain(making, seed)
  if not making.grouping then return {[0] = self.base} end
  local path = self:chain_path(making, seed)
  local file = io.open(path, "rb")
  if file then
    file:close()
  else
    s.save(path, simplify(self.base, making, self.settings, seed))
  end
  return s.load(path)
end

-- One chain a seed.
function Runs:chains(making, tell)
  local chains = {}
  for i = 1, making.grouping and self.settings.seeds or 1 do
    chains[i] = self:chain(making, self.settings.seed + i - 1)
    tell(("%s, seed %d"):format(making.name, i))
  end
  return chains
end

-- 2. What a level is, whatever steps it.

local function certificate(chain, level) return s.info(chain).levels[level + 1].certificate end

local function rms_of_frequencies(c)
  local sum, count = 0, math.min(#c.frequencies, frequency_count)
  for i = 1, count do sum = sum + c.frequencies[i].error ^ 2 end
  return percent * math.sqrt(sum / count)
end

local nothing = {value = 0, low = 0, high = 0}

function Runs:elastic_errors(chains, level)
  if level == 0 then return {frequencies = nothing, loads = nothing} end
  local frequencies, loads = {}, {}
  for i, chain in ipairs(chains) do
    local c = certificate(chain, level)
    frequencies[i], loads[i] = rms_of_frequencies(c), percent * c.held_out_load_error
  end
  return {frequencies = intervals.mean(frequencies), loads = intervals.mean(loads)}
end

-- 3. Surfaces, until the base itself is lost.

function Runs:scene_of_start(number, duration)
  return s.jittered(cut_scene(self.scene, duration), self.base,
    {number = number, jitter = self.settings.jitter, seed = self.settings.seed})
end

local function surface_options(more)
  local options = {frame_rate = frame_rate, ledger = false, quiet = true}
  for key, value in pairs(more or {}) do options[key] = value end
  return options
end

-- The last frame before the base and the base with half the step part, over all starts.
function Runs:find_chaos()
  local rows = self.store:rows("chaos", {"start", "time"}, function()
    local found = {}
    for start = 1, self.settings.starts do
      local scene = self:scene_of_start(start, self.scenario.duration)
      local base = s.run(self.base, scene, surface_options())
      local last = 0
      for _, d in ipairs(s.deviation(s.run(self.base, scene, surface_options{safety = 0.4}), base)) do
        if d.surface > chaos * self.size then break end
        last = d.time
      end
      found[start] = {start = start, time = last}
    end
    return found
  end)
  self.until_chaos = math.huge
  for _, row in ipairs(rows) do self.until_chaos = math.min(self.until_chaos, row.time) end
  if self.until_chaos < 1 / frame_rate then
    error("the base is lost within its first frame: half the step moves its nodes by more than "
      .. "1 % of its size; look at the scene, or leave surface out of --errors", 0)
  end
end

-- The base's runs until chaos, one a start.
function Runs:surface_references()
  if self.references then return self.references end
  self.references = {}
  for start = 1, self.settings.starts do
    self.references[start] = s.run(self.base, self:scene_of_start(start, self.until_chaos),
      surface_options())
  end
  return self.references
end

-- Rows of a time and, for each start, the distance over the base's size in percent.
function Runs:surface_rows(name, model, options)
  local columns = {"time"}
  for start = 1, self.settings.starts do columns[start + 1] = "start_" .. start end
  local rows = self.store:rows(name, columns, function()
    local table_rows = {}
    for start, reference in ipairs(self:surface_references()) do
      local run = s.run(model, self:scene_of_start(start, self.until_chaos),
        surface_options(options))
      for i, d in ipairs(s.deviation(run, reference)) do
        table_rows[i] = table_rows[i] or {d.time}
        table_rows[i][start + 1] = percent * d.surface / self.size
      end
    end
    return table_rows
  end)
  return rows
end

-- Means over the frames, one a start.
function Runs:surface_means(rows)
  local means = {}
  for start = 1, self.settings.starts do
    local sum = 0
    for _, row in ipairs(rows) do sum = sum + row["start_" .. start] end
    means[start] = sum / #rows
  end
  return means
end

local function mean_over_time(lists, starts)
  local curve = {}
  for i = 1, #lists[1] do
    local sum = 0
    for _, rows in ipairs(lists) do
      for start = 1, starts do sum = sum + rows[i]["start_" .. start] end
    end
    curve[i] = {lists[1][i].time, sum / (#lists * starts)}
  end
  return curve
end

-- Of a variant, or of the base with half its step: how far surfaces are, and when.
local function surface_error(self, lists)
  local means = {}
  for i, rows in ipairs(lists) do means[i] = self:surface_means(rows) end
  local m = s.statistics(by_start(means))
  return {value = m.mean, low = m.mean_low, high = m.mean_high,
          curve = mean_over_time(lists, self.settings.starts)}
end

function Runs:step_options(variant)
  local stepping = variant.stepping
  return {integrator = stepping.integrator, precision = stepping.precision,
          step = stepping.implicit and self.settings.implicit_step or nil}
end

function Runs:surface(variant, chains)
  local lists = {}
  for i, chain in ipairs(chains) do
    lists[i] = self:surface_rows(("surface/%s-seed-%d"):format(variant.name, i),
      chain[variant.level], self:step_options(variant))
  end
  return surface_error(self, lists)
end

function Runs:surface_floor()
  return surface_error(self, {self:surface_rows("surface/half-step", self.base, {safety = 0.4})})
end

-- 4. Where many starts end.

local function distances(store, name, model, scenario, options)
  local list = {}
  for i, row in ipairs(store:rows(name, distance_columns, function()
    return s.ensemble(model, scenario, options)
  end)) do
    list[i] = row.distance
  end
  return list
end

function Runs:ensemble_options(more)
  local options = {jitter = self.settings.jitter, seed = self.settings.seed,
                   starts = self.settings.starts}
  for key, value in pairs(more) do options[key] = value end
  return options
end

-- Of the base: the sample to compare with, and how far it is from itself.
function Runs:ensemble_base()
  self.base_distances = distances(self.store, "ensemble/base", self.base, self.scenario,
    self:ensemble_options{})
  local noise = {}
  for i, source in ipairs(noise_samples(self.settings.starts)) do
    noise[i] = distances(self.store, "ensemble/" .. source.name, self.base, self.scenario,
      self:ensemble_options(source.options))
  end
  self.noise_floor = s.noise_floor(noise, {size = self.settings.starts})
end

function Runs:ensemble(variant, chains)
  local seeds, inside = {}, 0
  for i, chain in ipairs(chains) do
    seeds[i] = distances(self.store, ("ensemble/%s-seed-%d"):format(variant.name, i),
      chain[variant.level], self.scenario, self:ensemble_options(self:step_options(variant)))
    if self.noise_floor:judge(self.base_distances, seeds[i]).inside then inside = inside + 1 end
  end
  local w = s.compare_samples(self.base_distances, by_start(seeds), {paired = true}).wasserstein
  return {value = w.value, low = w.low, high = w.high, inside = inside}
end

-- 5. Times.

-- One run alone on one thread, as nothing else is asked of it: wall-clock seconds and spring
-- updates a simulated second.
local function timed(model, scene, options)
  options.threads, options.frame_rate, options.ledger = 1, 0, false
  options.sleep, options.quiet = 0, true
  local run = s.run(model, scene, options)
  return run.wall_seconds / run.simulated, run.spring_updates / run.simulated, run.step
end

-- The part of the scene that is timed [s].
function Runs:plan_times()
  local rows = self.store:rows("timed", {"duration"}, function()
    local per_second = timed(self.base, cut_scene(self.scene, self.scenario.duration), {})
    return {{duration = math.min(self.scenario.duration, timed_seconds / per_second)}}
  end)
  self.timed_scene = s.scenario(cut_scene(self.scene, rows[1].duration))
end

local time_columns = {"repeat", "seed", "base_seconds", "seconds", "ratio", "spring_updates", "step"}

-- The base and the variant by turns, seed after seed, all from the scene's own start.
function Runs:times(variant, chains)
  local rows = self.store:rows("times/" .. variant.name, time_columns, function()
    local found, begun = {}, os.time()
    for turn = 1, self.settings.repeats do
      local seed = (turn - 1) % #chains + 1
      local base_seconds = timed(self.base, self.timed_scene, {})
      local seconds, updates, step = timed(chains[seed][variant.level], self.timed_scene,
        self:step_options(variant))
      found[turn] = {["repeat"] = turn, seed = seed, base_seconds = base_seconds,
                     seconds = seconds, ratio = seconds / base_seconds, spring_updates = updates,
                     step = step}
      if turn >= least_repeats and os.difftime(os.time(), begun) > patience then break end
    end
    return found
  end)
  local function column(name)
    local values = {}
    for i, row in ipairs(rows) do values[i] = row[name] end
    return values
  end
  return {ratio = intervals.median(column("ratio")), seconds = intervals.median(column("seconds")),
          spring_updates = averages.mean(column("spring_updates")), step = rows[1].step,
          repeats = #rows}
end

return pareto_runs
