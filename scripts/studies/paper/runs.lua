-- The runs for the two tables of the paper, as stages of a study.

local s = require "springlod"
local conversion = require "lib.conversion"
local lists = require "lib.lists"
local noise_samples = require "lib.noise_samples"
local paper_scenes = require "studies.paper.scenes"
local paper_variants = require "studies.paper.variants"
local run_estimate = require "lib.run_estimate"

local paper_runs = {}

local columns = {
  "start", "distance", "simulated", "spring_updates", "first_crossing", "inverted_at_end",
}

local merging_seconds = 0.1 -- of a chain that is not fitted

-- One throw of one body. `scene` is the Scenario, `table` the Lua table it was created from;
-- `variants` are those of the paper's table.
local function case(name, body, base, scene, variants)
  return {
    name = name, body = body, base = base, scene = s.scenario(scene), table = scene,
    variants = variants,
  }
end

-- The cases of Table 1 (`ball`) and Table 2 (`rods`, one per speed).
function paper_runs.cases(settings)
  local volumes = settings.volumes
  local ball = paper_scenes.ball{materials = settings.ball_materials, volumes = volumes}
  local rods = paper_scenes.rods{materials = settings.rods_materials, volumes = volumes}
  local cases = {ball = case("ball", "ball", ball, paper_scenes.roll{
    speed = settings.ball_speed, friction = settings.friction,
  }, paper_variants.wanted(paper_variants, settings)), rods = {}}
  for i, speed in ipairs(settings.speeds) do
    cases.rods[i] = case("rods-" .. speed, "rods", rods, paper_scenes.wall{
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

-- The chains of the variants are units of their own, which save them.
function paper_runs.chain_name(one, variant, seed)
  return ("%s-%s-seed-%d"):format(one.body, paper_variants.label(variant.name), seed)
end

local function chain_path(folder, name) return ("%s/models/%s.glb"):format(folder, name) end

-- Neighbouring units use the same chain.
local last = {}
function paper_runs.chain(folder, one, variant, seed)
  local path = chain_path(folder, paper_runs.chain_name(one, variant, seed))
  if last.path ~= path then last = {path = path, chain = s.load(path)} end
  return last.chain
end

local function make_chain(base, variant, seed)
  return s.simplify(base, {
    levels = not variant.keep and 2 or nil, keep = variant.keep, grouping = variant.grouping,
    border = variant.border, calibrate = variant.calibrate,
    calibration = variant.moments and {masses = "free", moments = variant.moments}, seed = seed,
  })
end

-- The stage that makes all chains: node and end counts of their levels.
function paper_runs.chain_stage(cases, settings)
  local units, known = {}, {}
  for _, one in ipairs(cases) do
    for _, variant in ipairs(one.variants) do
      paper_runs.by_seed(settings, function(seed)
        local name = paper_runs.chain_name(one, variant, seed)
        if known[name] then return end -- cases of the rods differ in their scenes only
        known[name] = true
        units[#units + 1] = {
          name = name,
          seconds = variant.calibrate and conversion.fit_time(one.base) or merging_seconds,
          make = function(folder)
            local chain, rows = make_chain(one.base, variant, seed), {}
            for level = 1, 2 do
              rows[level] = {level = level, nodes = chain[level].node_count,
                             ends = chain[level].end_count}
            end
            s.save(chain_path(folder, name), chain)
            return rows
          end,
        }
      end)
    end
  end
  return {name = "levels", columns = {"level", "nodes", "ends"}, units = units}
end

-- Processor time of a run of the base of a case or of a level [s]: about its share of the nodes.
local shares = {[0] = 1, 0.45, 0.2}
function paper_runs.seconds(one, level)
  one.seconds = one.seconds
    or one.scene.duration * (run_estimate.of(one.base, one.table, {}) or 0)
  return one.seconds * shares[level]
end

-- All samples of a case: name, kind ("base", "noise" or the label of a level), level, model (a
-- function of the folder that returns it) and options of s.ensemble.
local function samples(one, settings)
  local list = {}
  local function add(name, kind, level, model, options)
    options.jitter, options.seed = settings.jitter, settings.seed
    list[#list + 1] = {name = one.name .. "/" .. name, kind = kind, level = level, model = model,
                       options = options}
  end
  local function base() return one.base end
  add("base", "base", 0, base, {starts = settings.starts})
  for _, source in ipairs(noise_samples(settings.starts)) do
    add(source.name, "noise", 0, base, source.options)
  end
  for _, variant in ipairs(one.variants) do
    paper_runs.by_seed(settings, function(seed)
      for level = 1, 2 do
        local label = paper_variants.label(variant.name, level)
        local function model(folder)
          return paper_runs.chain(folder, one, variant, seed)[level]
        end
        add(("%s-seed-%d"):format(label, seed), label, level, model,
          {starts = settings.starts, contact = variant.contact})
      end
    end)
  end
  return list
end

-- The stage of all throws: an ensemble is a unit.
function paper_runs.stage(cases, settings)
  local units = {}
  for _, one in ipairs(cases) do
    for _, sample in ipairs(samples(one, settings)) do
      units[#units + 1] = {
        name = sample.name,
        seconds = function()
          return sample.options.starts * paper_runs.seconds(one, sample.level)
        end,
        make = function(folder)
          local throws = s.ensemble(sample.model(folder), one.scene, sample.options)
          return lists.with_fields(throws, columns)
        end,
      }
    end
  end
  return {name = "throws", columns = columns, units = units}
end

-- Whether a run counts as turned over: its final state has inverted corners or, in a study without
-- corners, springs inverted during it.
local function is_turned_over(row, settings)
  if settings.volumes then return row.inverted_at_end > 0 end
  return row.first_crossing ~= nil
end

-- The distances of a sample and the number of its runs that turned over.
local function distances(rows, settings)
  local list, turned_over = {}, 0
  for i, row in ipairs(rows) do
    list[i] = row.distance
    if is_turned_over(row, settings) then turned_over = turned_over + 1 end
  end
  return list, turned_over
end

-- Reads the results of a case into its fields: base_distances, noise (one list per source), levels
-- (by label, one list of distances per seed) and turned_over (by kind, the number of runs).
local function read_case(one, settings, results)
  one.noise, one.levels, one.turned_over = {}, {}, {}
  for _, sample in ipairs(samples(one, settings)) do
    local rows, reason = results:rows("throws", sample.name)
    if rows then
      local found, turned_over = distances(rows, settings)
      one.turned_over[sample.kind] = (one.turned_over[sample.kind] or 0) + turned_over
      if sample.kind == "base" then
        one.base_distances = found
      elseif sample.kind == "noise" then
        table.insert(one.noise, found)
      else
        one.levels[sample.kind] = one.levels[sample.kind] or {}
        table.insert(one.levels[sample.kind], found)
      end
    elseif sample.level == 0 then
      s.say(("%s is left out, as its base has no result: %s"):format(one.name, reason))
      return false
    end
  end
  return true
end

-- Those of the cases that can be compared with their base, with the fields of read_case. Levels
-- without a result are left out.
function paper_runs.read(cases, settings, results)
  local complete = {}
  for _, one in ipairs(cases) do
    if read_case(one, settings, results) then complete[#complete + 1] = one end
  end
  return complete
end

return paper_runs
