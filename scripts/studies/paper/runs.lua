-- The runs for the two tables of the paper.

local s = require "springlod"
local noise_samples = require "lib.noise_samples"
local paper_scenes = require "studies.paper.scenes"
local paper_variants = require "studies.paper.variants"
local progress = require "lib.progress"

local paper_runs = {}

local columns = {
  "start", "distance", "simulated", "spring_updates", "first_crossing", "inverted_at_end",
}

-- One throw of one body. `scene` is the Scenario, `table` the Lua table it was created from;
-- `variants` are those of the paper's table.
local function case(name, base, scene, variants)
  return {
    name = name, base = base, scene = s.scenario(scene), table = scene, variants = variants,
  }
end

-- The cases of Table 1 (`ball`) and Table 2 (`rods`, one per speed).
function paper_runs.cases(settings)
  local volumes = settings.volumes
  local ball = paper_scenes.ball{materials = settings.ball_materials, volumes = volumes}
  local rods = paper_scenes.rods{materials = settings.rods_materials, volumes = volumes}
  local cases = {ball = case("ball", ball, paper_scenes.roll{
    speed = settings.ball_speed, friction = settings.friction,
  }, paper_variants.wanted(paper_variants, settings)), rods = {}}
  for i, speed in ipairs(settings.speeds) do
    cases.rods[i] = case("rods-" .. speed, rods, paper_scenes.wall{
      speed = speed * settings.speed_scale, friction = settings.friction,
    }, paper_variants.wanted({paper_variants[4], paper_variants[2]}, settings))
    cases.rods[i].speed = speed
  end
  return cases
end

-- Calls visit(label, variant, level) for the levels of a case, variant by variant.
function paper_runs.each_level(one, visit)
  for _, variant in ipairs(one.variants) do
    for level = 1, 2 do visit(paper_variants.label(variant.name, level), variant, level) end
  end
end

-- A list of visit(seed) for all simplification seeds.
function paper_runs.by_seed(settings, visit)
  local list = {}
  for seed = settings.seed, settings.seed + settings.simplifications - 1 do
    list[#list + 1] = visit(seed)
  end
  return list
end

-- The chain of a variant and a seed, built once.
local chains = setmetatable({}, {__mode = "k"})
function paper_runs.chain(base, variant, seed)
  chains[base] = chains[base] or {}
  -- Variants that differ only in their contact share a chain.
  local key = table.concat({tostring(variant.grouping), tostring(variant.border),
                            tostring(variant.calibrate), tostring(variant.moments), seed,
                            table.unpack(variant.keep or {})}, " ")
  chains[base][key] = chains[base][key] or s.simplify(base, {
    levels = not variant.keep and 2 or nil, keep = variant.keep, grouping = variant.grouping,
    border = variant.border, calibrate = variant.calibrate,
    calibration = variant.moments and {masses = "free", moments = variant.moments}, seed = seed,
  })
  return chains[base][key]
end

-- All samples of a case: name, kind ("base", "noise" or the label of a level), model (a function
-- that returns it) and options of s.ensemble.
local function samples(one, settings)
  local list = {}
  local function add(name, kind, model, options)
    options.jitter, options.seed = settings.jitter, settings.seed
    list[#list + 1] = {name = one.name .. "/" .. name, kind = kind, model = model,
                       options = options}
  end
  local function base() return one.base end
  add("base", "base", base, {starts = settings.starts})
  for _, source in ipairs(noise_samples(settings.starts)) do
    add(source.name, "noise", base, source.options)
  end
  paper_runs.each_level(one, function(label, variant, level)
    paper_runs.by_seed(settings, function(seed)
      local function model() return paper_runs.chain(one.base, variant, seed)[level] end
      add(("%s-seed-%d"):format(label, seed), label, model,
        {starts = settings.starts, contact = variant.contact})
    end)
  end)
  return list
end

-- Whether a run counts as turned over: its final state has inverted corners or, in a study without
-- corners, springs inverted during it.
local function is_turned_over(row, settings)
  if settings.volumes then return row.inverted_at_end > 0 end
  return row.first_crossing ~= ""
end

-- The distances of a sample, run if they are not in the store, and the number of its runs that
-- turned over.
local function distances(sample, scene, settings, store)
  local rows = store:rows(sample.name, columns, function()
    return s.ensemble(sample.model(), scene, sample.options)
  end)
  local list, turned_over = {}, 0
  for i, row in ipairs(rows) do
    list[i] = row.distance
    if is_turned_over(row, settings) then turned_over = turned_over + 1 end
  end
  return list, turned_over
end

-- Runs the samples of `cases` that are not in the store. Each case gets the fields base_distances,
-- noise (one list per source), levels (by label, one list of distances per seed) and turned_over
-- (by kind, the number of runs).
function paper_runs.run(cases, settings, store)
  local missing = 0
  for _, one in ipairs(cases) do
    one.samples = samples(one, settings)
    for _, sample in ipairs(one.samples) do
      if not store:has(sample.name) then missing = missing + 1 end
    end
  end
  local report = progress(missing)
  for _, one in ipairs(cases) do
    one.noise, one.levels, one.turned_over = {}, {}, {}
    for _, sample in ipairs(one.samples) do
      local new = not store:has(sample.name)
      local found, turned_over = distances(sample, one.scene, settings, store)
      one.turned_over[sample.kind] = (one.turned_over[sample.kind] or 0) + turned_over
      if new then report(sample.name) end
      if sample.kind == "base" then
        one.base_distances = found
      elseif sample.kind == "noise" then
        table.insert(one.noise, found)
      else
        one.levels[sample.kind] = one.levels[sample.kind] or {}
        table.insert(one.levels[sample.kind], found)
      end
    end
  end
end

return paper_runs
