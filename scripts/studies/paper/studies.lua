-- The studies that accompany the two tables of the paper: early errors, the paper's own method of
-- three runs, the energy measure it cites, elasticity without a scene, random models and the
-- sensitivity of the scenes. Each function returns a stage, whose units make the rows of a table.

local s = require "springlod"
local cut = require "lib.cut_scene"
local paper_numbers = require "studies.paper.numbers"
local paper_runs = require "studies.paper.runs"
local paper_scenes = require "studies.paper.scenes"
local paper_variants = require "studies.paper.variants"
local run_estimate = require "lib.run_estimate"

local paper_studies = {}

local mean = s.mean

local function standard_deviation(list)
  local middle, sum = mean(list), 0
  for _, value in ipairs(list) do sum = sum + (value - middle) ^ 2 end
  return math.sqrt(sum / (#list - 1))
end

-- A list of units that make one row each.
local function new_units()
  local units = {}
  function units.add(name, seconds, make)
    units[#units + 1] = {name = name, seconds = seconds, make = make}
  end
  return units
end

-- The value that make() returned for `key`, which is computed once.
local function kept(values, key, make)
  values[key] = values[key] or make()
  return values[key]
end

local function positions_at(model, scene, time, contact)
  return s.run(model, cut(scene, time),
    {frame_rate = 0, ledger = false, quiet = true, contact = contact}).final.x
end

-- Mass-weighted rms distance between the nodes of a level and the centers of mass of their groups
-- in the base.
local function level_error(chain, level, of_base, of_level)
  local map, base, sums = chain:group_map(level), chain[0], {}
  for i, x in ipairs(of_base) do
    local sum, m = sums[map[i]] or {0, 0, 0, 0}, base:node(i).mass
    for axis = 1, 3 do sum[axis] = sum[axis] + m * x[axis] end
    sum[4] = sum[4] + m
    sums[map[i]] = sum
  end
  local square, mass = 0, 0
  for node, sum in ipairs(sums) do
    for axis = 1, 3 do
      square = square + sum[4] * (sum[axis] / sum[4] - of_level[node][axis]) ^ 2
    end
    mass = mass + sum[4]
  end
  return math.sqrt(square / mass)
end

-- Of the base of a case: the times at which errors are measured, and its positions then.
local early = {}
local function early_base(one)
  return kept(early, one, function()
    local contact = s.run(one.base, cut(one.table, 1),
      {frame_rate = 0, ledger = false, quiet = true}).first_contact
    local base = {times = {contact, 1}}
    for i, time in ipairs(base.times) do base[i] = positions_at(one.base, one.table, time) end
    return base
  end)
end

-- Errors before trajectories diverge: at the first contact of the base, and after 1 s. Means over
-- the simplification seeds.
function paper_studies.early_errors(cases, settings)
  local units = new_units()
  for _, one in ipairs(cases) do
    paper_runs.each_level(one, function(label, variant, level)
      local function seconds()
        return 2 / one.scene.duration * settings.simplifications * paper_runs.seconds(one, level)
      end
      units.add(one.name .. "/" .. label, seconds, function(folder)
        local base = early_base(one)
        local function error_at(i)
          return mean(paper_runs.by_seed(settings, function(seed)
            local chain = paper_runs.chain(folder, one, variant, seed)
            return level_error(chain, level, base[i],
              positions_at(chain[level], one.table, base.times[i], variant.contact))
          end))
        end
        return {case = one.name, model = label, contact_time = base.times[1],
                at_contact = error_at(1), after_1_s = error_at(2)}
      end)
    end)
  end
  return {name = "early-errors", units = units,
          columns = {"case", "model", "contact_time", "at_contact", "after_1_s"}}
end

-- The paper's method: three runs from the same start with different time steps. The spread is the
-- standard deviation of the three distances.
function paper_studies.three_runs(cases, settings)
  local safeties = {0.8, 0.7, 0.6}
  local units = new_units()
  local function add(one, label, level, model, contact)
    local function seconds() return #safeties * paper_runs.seconds(one, level) end
    units.add(one.name .. "/" .. label, seconds, function(folder)
      local found = {}
      for i, safety in ipairs(safeties) do
        found[i] = s.ensemble(model(folder), one.scene,
          {starts = 1, safety = safety, contact = contact})[1].distance
      end
      local theirs = paper_numbers.at(label, one.speed) or {}
      return {speed = one.speed, model = label, distance = mean(found),
              spread = standard_deviation(found), paper_distance = theirs[1],
              paper_spread = theirs[2]}
    end)
  end
  for _, one in ipairs(cases) do
    add(one, "base", 0, function() return one.base end)
    paper_runs.each_level(one, function(label, variant, level)
      add(one, label, level, function(folder)
        return paper_runs.chain(folder, one, variant, settings.seed)[level]
      end, variant.contact)
    end)
  end
  return {name = "three-runs", units = units, columns = {
    "speed", "model", "distance", "spread", "paper_distance", "paper_spread"}}
end

-- Mechanical energy of each frame and the largest kinetic energy of a run from the unjittered
-- start.
local function energies(model, scene, options)
  local list, kinetic = {}, 0
  local run = s.run(model, scene,
    {frame_rate = 60, quiet = true, safety = options.safety, contact = options.contact})
  for i, entry in ipairs(run.ledger) do
    list[i] = entry.kinetic + entry.elastic + entry.gravity + entry.contact
    kinetic = math.max(kinetic, entry.kinetic)
  end
  return list, kinetic
end

local function largest_difference(a, b)
  local largest = 0
  for i = 1, math.min(#a, #b) do largest = math.max(largest, math.abs(a[i] - b[i])) end
  return largest
end

local base_energies = {}

-- The largest energy difference (Yeh et al. 2009) relative to the largest kinetic energy of the
-- base, for each level (mean over the simplification seeds) and for the base at half the time step.
function paper_studies.energy(cases, settings)
  local units = new_units()
  local function add(one, label, seconds, differences)
    units.add(one.name .. "/" .. label, seconds, function(folder)
      local base, kinetic = table.unpack(kept(base_energies, one, function()
        return {energies(one.base, one.scene, {})}
      end))
      return {case = one.name, model = label,
              energy_difference = mean(differences(base, folder)) / kinetic}
    end)
  end
  for _, one in ipairs(cases) do
    local function half_seconds() return 3 * paper_runs.seconds(one, 0) end -- and the base
    add(one, "base at half the step", half_seconds, function(base)
      return {largest_difference(base, (energies(one.base, one.scene, {safety = 0.4})))}
    end)
    paper_runs.each_level(one, function(label, variant, level)
      local function seconds()
        return settings.simplifications * paper_runs.seconds(one, level)
      end
      add(one, label, seconds, function(base, folder)
        return paper_runs.by_seed(settings, function(seed)
          local model = paper_runs.chain(folder, one, variant, seed)[level]
          return largest_difference(base,
            (energies(model, one.scene, {contact = variant.contact})))
        end)
      end)
    end)
  end
  return {name = "energy", units = units, columns = {"case", "model", "energy_difference"}}
end

-- Sensitivity of each scene to a change of 0.1 % in the start. `way`: mean distance travelled by
-- the base after `time`; `spread`: its standard deviation; `growth`: relative spread of the
-- distance over that of the start; `level_difference`: difference of LOD-hb-1 from the base. The
-- paper mentions the thrown die but excludes it from its tests.
function paper_studies.sensitivity(settings)
  local jitter = 0.001 -- relative, uniform: a standard deviation of jitter / sqrt(3)
  local body, contact = {volumes = settings.volumes}, {friction = settings.friction}
  local scenes = {
    {"die", paper_scenes.block, paper_scenes.die(contact)},
    {"roll", paper_scenes.ball, paper_scenes.roll(contact)},
    {"wall", paper_scenes.rods, paper_scenes.wall(contact)},
  }
  local options = {starts = settings.starts, jitter = jitter, seed = settings.seed}
  local function distances(model, scene)
    local list = {}
    for i, run in ipairs(s.ensemble(model, scene, options)) do list[i] = run.distance end
    return list
  end
  local models = {}
  local function models_of(name, make)
    return kept(models, name, function()
      local base = (make(body))
      local variant = paper_variants[4]
      return {base, s.simplify(base, {levels = 2, grouping = variant.grouping,
                                      border = variant.border, seed = settings.seed})[1]}
    end)
  end
  local units = new_units()
  for _, entry in ipairs(scenes) do
    local name, make, scene = table.unpack(entry)
    scene.measure_from = nil -- all scenes: measured from the start
    for _, time in ipairs{0.25, 0.5, 1, 2, 4} do
      local function seconds()
        return 1.5 * settings.starts * time * run_estimate.of(models_of(name, make)[1], scene, {})
      end
      units.add(("%s, %g s"):format(name, time), seconds, function()
        local base, level = table.unpack(models_of(name, make))
        local cut_short = cut(scene, time)
        local of_base, of_level = distances(base, cut_short), distances(level, cut_short)
        local spread = standard_deviation(of_base)
        return {scene = name, time = time, way = mean(of_base), spread = spread,
                growth = spread / mean(of_base) / (jitter / math.sqrt(3)),
                level_difference = mean(of_level) - mean(of_base)}
      end)
    end
  end
  return {name = "sensitivity", units = units, columns = {
    "scene", "time", "way", "spread", "growth", "level_difference"}}
end

local function frequencies(model)
  local list = {}
  for i, mode in ipairs(s.modes(model, {count = 10})) do list[i] = mode.frequency end
  return list
end

-- The simplification methods that the elasticity study compares: a name, and the options of
-- s.simplify or the style of s.refill.
local function elasticity_methods()
  local list = {}
  for _, variant in ipairs(paper_variants) do
    list[#list + 1] = {name = paper_variants.label(variant.name),
                       options = {grouping = variant.grouping, border = variant.border}}
  end
  list[#list + 1] = {name = "LOD-h by gradient alone", options = {grouping = "priority_hard"}}
  list[#list + 1] = {name = "LOD with mass by proximity", options = {mass = "proximity"}}
  for _, style in ipairs{"lattice", "random"} do
    list[#list + 1] = {name = "refilled " .. style, style = style}
  end
  return list
end

local function elasticity_chain(method, base, grid, seed)
  if method.style then
    local counts = s.simplify(base, {levels = 2, seed = 1}) -- node counts similar to merging
    return s.refill(base, grid, {
      nodes = {counts[1].node_count, counts[2].node_count}, style = method.style,
      lattice = "centers", seed = seed, volumes = false,
    })
  end
  local options = {levels = 2, seed = seed}
  for name, value in pairs(method.options) do options[name] = value end
  return s.simplify(base, options)
end

local function trace(inertia) return inertia[1][1] + inertia[2][2] + inertia[3][3] end

local merging_seconds = 0.4 -- two levels of a body and their frequencies, about

-- Rows of a method for the elasticity study, one for each level.
local function elasticity_rows(body, method, settings)
  local found, base, of_base = {{}, {}}, body.base, body.frequencies
  for seed = settings.seed, settings.seed + settings.simplifications - 1 do
    local chain = elasticity_chain(method, base, body.grid, seed)
    for level = 1, 2 do
      local errors, biases = {}, {}
      for i, frequency in ipairs(frequencies(chain[level])) do
        biases[i] = 100 * (frequency / of_base[i] - 1)
        errors[i] = math.abs(biases[i])
      end
      table.insert(found[level], {
        nodes = chain[level].node_count, error = mean(errors), bias = mean(biases),
        inertia = 100 * (trace(chain[level].inertia) / trace(base.inertia) - 1),
      })
    end
  end
  local rows = {}
  for level = 1, 2 do
    local function over_seeds(key)
      local list = {}
      for i, entry in ipairs(found[level]) do list[i] = entry[key] end
      return mean(list)
    end
    rows[level] = {
      level = level, nodes = math.floor(over_seeds("nodes") + 0.5),
      error_percent = over_seeds("error"), bias_percent = over_seeds("bias"),
      inertia_percent = over_seeds("inertia"),
    }
  end
  return rows
end

-- Elasticity without a scene: mean absolute and mean signed error of the ten lowest frequencies of
-- each level, and the error of its moment of inertia. Means over the simplification seeds.
function paper_studies.elasticity(settings)
  local bodies = {
    {"ball", paper_scenes.ball}, {"rods", paper_scenes.rods},
    {"bar", paper_scenes.block, {size = {4, 4, 20}}},
    {"cube", paper_scenes.block, {size = {8, 8, 8}}},
  }
  local units, bases = new_units(), {}
  for _, body in ipairs(bodies) do
    local name, make, options = table.unpack(body)
    local function measured()
      return kept(bases, name, function()
        local base, grid = make(options)
        return {base = base, grid = grid, frequencies = frequencies(base)}
      end)
    end
    for _, method in ipairs(elasticity_methods()) do
      local seconds = settings.simplifications * merging_seconds
      units.add(name .. "/" .. method.name, seconds, function()
        local rows = elasticity_rows(measured(), method, settings)
        for _, row in ipairs(rows) do row.body, row.way = name, method.name end
        return rows
      end)
    end
  end
  return {name = "elasticity", units = units, columns = {
    "body", "way", "level", "nodes", "error_percent", "bias_percent", "inertia_percent"}}
end

local random_seconds = 3 -- of a random model of 1,000 nodes, about

-- Random models: Young's modulus by eq. 2 over the one measured in a static stretch test, and
-- Poisson's ratio. Means over seeds.
function paper_studies.random_models(settings)
  local units = new_units()
  for _, ends in ipairs{14, 18, 24} do
    local seconds = settings.simplifications * random_seconds
    units.add(ends .. " ends a node", seconds, function()
      local _, grid = paper_scenes.block{size = {10, 10, 10}}
      local factors, ratios = {}, {}
      for seed = settings.seed, settings.seed + settings.simplifications - 1 do
        local about = s.random(grid, {
          nodes = 1000, ends = ends, seed = seed, volumes = false,
        }).provenance
        table.insert(factors, tonumber(about.rescaled))
        table.insert(ratios, tonumber(about.measured_poisson))
      end
      return {nodes = 1000, ends_a_node = ends, eq_2_over_measured = mean(factors),
              poisson = mean(ratios)}
    end)
  end
  return {name = "random-models", units = units, columns = {
    "nodes", "ends_a_node", "eq_2_over_measured", "poisson"}}
end

return paper_studies
