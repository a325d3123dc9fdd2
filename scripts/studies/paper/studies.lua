-- The studies that accompany the two tables of the paper: early errors, the paper's own method of
-- three runs, the energy measure it cites, elasticity without a scene, random models and the
-- sensitivity of the scenes.

local s = require "springlod"
local cut = require "lib.cut_scene"
local paper_numbers = require "studies.paper.numbers"
local paper_runs = require "studies.paper.runs"
local paper_scenes = require "studies.paper.scenes"
local paper_variants = require "studies.paper.variants"

local paper_studies = {}

local mean = s.mean

local function standard_deviation(list)
  local middle, sum = mean(list), 0
  for _, value in ipairs(list) do sum = sum + (value - middle) ^ 2 end
  return math.sqrt(sum / (#list - 1))
end

-- The name of a study in the store; it depends on the variants, which may change between calls.
local function kept_as(name, settings)
  return name .. "-of-" .. table.concat(settings.variants, "+")
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

-- Errors before trajectories diverge: at the first contact of the base, and after 1 s. Means over
-- the simplification seeds.
function paper_studies.early_errors(cases, settings, store)
  local columns = {"case", "model", "contact_time", "at_contact", "after_1_s"}
  return store:rows(kept_as("early-errors", settings), columns, function()
    local rows = {}
    for _, one in ipairs(cases) do
      local contact = s.run(one.base, cut(one.table, 1),
        {frame_rate = 0, ledger = false, quiet = true}).first_contact
      local times = {contact, 1}
      local base = {}
      for i, time in ipairs(times) do base[i] = positions_at(one.base, one.table, time) end
      paper_runs.each_level(one, function(label, variant, level)
        local function error_at(i)
          return mean(paper_runs.by_seed(settings, function(seed)
            local chain = paper_runs.chain(one.base, variant, seed)
            return level_error(chain, level, base[i],
              positions_at(chain[level], one.table, times[i], variant.contact))
          end))
        end
        rows[#rows + 1] = {
          case = one.name, model = label, contact_time = contact, at_contact = error_at(1),
          after_1_s = error_at(2),
        }
      end)
    end
    return rows
  end), columns
end

-- The paper's method: three runs from the same start with different time steps. The spread is the
-- standard deviation of the three distances.
function paper_studies.three_runs(cases, settings, store)
  local columns = {"speed", "model", "distance", "spread", "paper_distance", "paper_spread"}
  local safeties = {0.8, 0.7, 0.6}
  local function row(one, label, model, contact)
    local found = {}
    for i, safety in ipairs(safeties) do
      found[i] = s.ensemble(model, one.scene,
        {starts = 1, safety = safety, contact = contact})[1].distance
    end
    local theirs = paper_numbers.at(label, one.speed) or {}
    return {
      speed = one.speed, model = label, distance = mean(found),
      spread = standard_deviation(found), paper_distance = theirs[1], paper_spread = theirs[2],
    }
  end
  return store:rows(kept_as("three-runs", settings), columns, function()
    local rows = {}
    for _, one in ipairs(cases) do
      rows[#rows + 1] = row(one, "base", one.base)
      paper_runs.each_level(one, function(label, variant, level)
        rows[#rows + 1] = row(one, label,
          paper_runs.chain(one.base, variant, settings.seed)[level], variant.contact)
      end)
    end
    return rows
  end), columns
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

-- The largest energy difference (Yeh et al. 2009) relative to the largest kinetic energy of the
-- base, for each level (mean over the simplification seeds) and for the base at half the time step.
function paper_studies.energy(cases, settings, store)
  local columns = {"case", "model", "energy_difference"}
  return store:rows(kept_as("energy", settings), columns, function()
    local rows = {}
    for _, one in ipairs(cases) do
      local base, kinetic = energies(one.base, one.scene, {})
      local function add(label, differences)
        rows[#rows + 1] = {
          case = one.name, model = label, energy_difference = mean(differences) / kinetic,
        }
      end
      local at_half = energies(one.base, one.scene, {safety = 0.4})
      add("base at half the step", {largest_difference(base, at_half)})
      paper_runs.each_level(one, function(label, variant, level)
        add(label, paper_runs.by_seed(settings, function(seed)
          local model = paper_runs.chain(one.base, variant, seed)[level]
          return largest_difference(base,
            (energies(model, one.scene, {contact = variant.contact})))
        end))
      end)
    end
    return rows
  end), columns
end

-- Sensitivity of each scene to a change of 0.1 % in the start. `way`: mean distance travelled by
-- the base after `time`; `spread`: its standard deviation; `growth`: relative spread of the
-- distance over that of the start; `level_difference`: difference of LOD-hb-1 from the base. The
-- paper mentions the thrown die but excludes it from its tests.
function paper_studies.sensitivity(settings, store)
  local columns = {"scene", "time", "way", "spread", "growth", "level_difference"}
  local jitter = 0.001 -- relative, uniform: a standard deviation of jitter / sqrt(3)
  local body, contact = {volumes = settings.volumes}, {friction = settings.friction}
  local scenes = {
    {"die", paper_scenes.block(body), paper_scenes.die(contact)},
    {"roll", paper_scenes.ball(body), paper_scenes.roll(contact)},
    {"wall", paper_scenes.rods(body), paper_scenes.wall(contact)},
  }
  return store:rows("sensitivity", columns, function()
    local rows = {}
    local function distances(model, scene)
      local list = {}
      local options = {starts = settings.starts, jitter = jitter, seed = settings.seed}
      for i, run in ipairs(s.ensemble(model, scene, options)) do list[i] = run.distance end
      return list
    end
    for _, entry in ipairs(scenes) do
      local name, base, scene = table.unpack(entry)
      local level = paper_runs.chain(base, paper_variants[4], settings.seed)[1]
      scene.measure_from = nil -- all scenes: measured from the start
      for _, time in ipairs{0.25, 0.5, 1, 2, 4} do
        local cut_short = cut(scene, time)
        local of_base, of_level = distances(base, cut_short), distances(level, cut_short)
        local spread = standard_deviation(of_base)
        rows[#rows + 1] = {
          scene = name, time = time, way = mean(of_base), spread = spread,
          growth = spread / mean(of_base) / (jitter / math.sqrt(3)),
          level_difference = mean(of_level) - mean(of_base),
        }
      end
    end
    return rows
  end), columns
end

local function frequencies(model)
  local list = {}
  for i, mode in ipairs(s.modes(model, {count = 10})) do list[i] = mode.frequency end
  return list
end

-- The simplification methods that the elasticity study compares: a name and chain(seed).
local function simplification_methods(base, grid)
  local list = {}
  local function add(name, options)
    list[#list + 1] = {name = name, chain = function(seed)
      options.levels, options.seed = 2, seed
      return s.simplify(base, options)
    end}
  end
  for _, variant in ipairs(paper_variants) do
    add(paper_variants.label(variant.name),
      {grouping = variant.grouping, border = variant.border})
  end
  add("LOD-h by gradient alone", {grouping = "priority_hard"})
  add("LOD with mass by proximity", {mass = "proximity"})
  local counts = s.simplify(base, {levels = 2, seed = 1}) -- node counts similar to merging
  for _, style in ipairs{"lattice", "random"} do
    list[#list + 1] = {name = "refilled " .. style, chain = function(seed)
      return s.refill(base, grid, {
        nodes = {counts[1].node_count, counts[2].node_count}, style = style, lattice = "centers",
        seed = seed, volumes = false,
      })
    end}
  end
  return list
end

local function trace(inertia) return inertia[1][1] + inertia[2][2] + inertia[3][3] end

-- Elasticity without a scene: mean absolute and mean signed error of the ten lowest frequencies of
-- each level, and the error of its moment of inertia. Means over the simplification seeds.
function paper_studies.elasticity(settings, store)
  local columns = {
    "body", "way", "level", "nodes", "error_percent", "bias_percent", "inertia_percent",
  }
  local bodies = {
    {"ball", paper_scenes.ball()}, {"rods", paper_scenes.rods()},
    {"bar", paper_scenes.block{size = {4, 4, 20}}}, {"cube", paper_scenes.block{size = {8, 8, 8}}},
  }
  return store:rows("elasticity", columns, function()
    local rows = {}
    for _, body in ipairs(bodies) do
      local name, base, grid = table.unpack(body)
      local of_base = frequencies(base)
      for _, method in ipairs(simplification_methods(base, grid)) do
        local found = {{}, {}}
        for seed = settings.seed, settings.seed + settings.simplifications - 1 do
          local chain = method.chain(seed)
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
        for level = 1, 2 do
          local function over_seeds(key)
            local list = {}
            for i, entry in ipairs(found[level]) do list[i] = entry[key] end
            return mean(list)
          end
          rows[#rows + 1] = {
            body = name, way = method.name, level = level,
            nodes = math.floor(over_seeds("nodes") + 0.5), error_percent = over_seeds("error"),
            bias_percent = over_seeds("bias"), inertia_percent = over_seeds("inertia"),
          }
        end
      end
    end
    return rows
  end), columns
end

-- Random models: Young's modulus by eq. 2 over the one measured in a static stretch test, and
-- Poisson's ratio. Means over seeds.
function paper_studies.random_models(settings, store)
  local columns = {"nodes", "ends_a_node", "eq_2_over_measured", "poisson"}
  return store:rows("random-models", columns, function()
    local _, grid = paper_scenes.block{size = {10, 10, 10}}
    local rows = {}
    for _, ends in ipairs{14, 18, 24} do
      local factors, ratios = {}, {}
      for seed = settings.seed, settings.seed + settings.simplifications - 1 do
        local about = s.random(grid, {
          nodes = 1000, ends = ends, seed = seed, volumes = false,
        }).provenance
        table.insert(factors, tonumber(about.rescaled))
        table.insert(ratios, tonumber(about.measured_poisson))
      end
      rows[#rows + 1] = {
        nodes = 1000, ends_a_node = ends, eq_2_over_measured = mean(factors),
        poisson = mean(ratios),
      }
    end
    return rows
  end), columns
end

return paper_studies
