-- The chains of springlod pareto, kept as assets, and their elastic errors, which do not depend on
-- the integrator.

local s = require "springlod"
local conversion = require "lib.conversion"
local intervals = require "lib.intervals"

local pareto_chains = {}

local frequency_count = 20
local percent = 100
local merging_seconds = 0.5 -- of levels that are not fitted, and their certificates, about

-- A strong border may be unable to reach the requested node counts; then the grouping determines
-- them.
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

local function rms_of_frequencies(certificate)
  local sum, count = 0, math.min(#certificate.frequencies, frequency_count)
  for i = 1, count do sum = sum + certificate.frequencies[i].error ^ 2 end
  return math.sqrt(sum / count)
end

local function name_of(making, number) return ("%s-seed-%d"):format(making.name, number) end

local function path_of(study, folder, making, number)
  return ("%s/models/%s-seed-%d.glb"):format(folder, making.name, study.settings.seed + number - 1)
end

-- One row for each level: its counts and elastic errors in percent.
local function rows_of(chain)
  local rows = {}
  for number, level in ipairs(s.info(chain).levels) do
    local certificate = level.certificate
    if certificate then
      rows[#rows + 1] = {
        level = number - 1, nodes = level.nodes, springs = chain[number - 1].spring_count,
        frequencies = percent * rms_of_frequencies(certificate),
        loads = percent * certificate.held_out_load_error,
      }
    end
  end
  return rows
end

-- The stage that makes and certifies the levels of each method and seed. `study`: base, settings.
function pareto_chains.stage(study, methods)
  local units = {}
  for _, making in ipairs(methods) do
    for number = 1, making.grouping and study.settings.seeds or 0 do
      units[#units + 1] = {
        name = name_of(making, number),
        seconds = making.calibration == "modes" and conversion.fit_time(study.base)
          or merging_seconds,
        make = function(folder)
          local chain = simplify(study.base, making, study.settings,
            study.settings.seed + number - 1)
          s.save(path_of(study, folder, making, number), chain)
          return rows_of(chain)
        end,
      }
    end
  end
  return {name = "levels", columns = {"level", "nodes", "springs", "frequencies", "loads"},
          units = units}
end

-- How many chains there are of a method.
function pareto_chains.count(study, making) return making.grouping and study.settings.seeds or 1 end

-- The level of a variant made with a seed. Neighbouring units use the same chains. `earlier`: see
-- lib/study.lua.
local kept = {}
function pareto_chains.level(study, folder, variant, number, earlier)
  local making = variant.making
  if not making.grouping then return study.base end
  if kept.making ~= making then kept = {making = making} end
  if not kept[number] then
    earlier("levels", name_of(making, number))
    kept[number] = s.load(path_of(study, folder, making, number))
  end
  return kept[number][variant.level]
end

local zero = {value = 0, low = 0, high = 0}

-- What is known of a level of a method: nodes and springs with the first seed, frequencies and
-- loads as elastic errors in percent, with intervals over the seeds. nil and the reason if it could
-- not be made.
function pareto_chains.read(study, results, making, level)
  if not making.grouping then
    return {nodes = study.base.node_count, springs = study.base.spring_count, frequencies = zero,
            loads = zero}
  end
  local frequencies, loads, first = {}, {}, nil
  for number = 1, study.settings.seeds do
    local rows, reason = results:rows("levels", name_of(making, number))
    if not rows then return nil, reason end
    local row = rows[level]
    first = first or row
    frequencies[number], loads[number] = row.frequencies, row.loads
  end
  return {nodes = first.nodes, springs = first.springs,
          frequencies = intervals.mean(frequencies), loads = intervals.mean(loads)}
end

return pareto_chains
