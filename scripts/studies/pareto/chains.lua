-- The chains of springlod pareto, kept as assets, and their elastic errors, which do not depend on
-- the integrator.

local s = require "springlod"
local command = require "lib.command"
local intervals = require "lib.intervals"

local pareto_chains = {}

local frequency_count = 20
local percent = 100

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

-- The certified chains of a simplification method, one per seed. `study`: base, settings, folder.
-- Calls report(name) after each chain.
function pareto_chains.of(study, making, report)
  if not making.grouping then return {{[0] = study.base}} end
  local chains = {}
  for i = 1, study.settings.seeds do
    local seed = study.settings.seed + i - 1
    local path = ("%s/models/%s-seed-%d.glb"):format(study.folder, making.name, seed)
    if not command.exists(path) then
      s.save(path, simplify(study.base, making, study.settings, seed))
    end
    chains[i] = s.load(path)
    report(("%s, seed %d"):format(making.name, seed))
  end
  return chains
end

local function rms_of_frequencies(certificate)
  local sum, count = 0, math.min(#certificate.frequencies, frequency_count)
  for i = 1, count do sum = sum + certificate.frequencies[i].error ^ 2 end
  return math.sqrt(sum / count)
end

local zero = {value = 0, low = 0, high = 0}

-- Elastic errors of a level in percent, with intervals over the seeds.
function pareto_chains.elastic_errors(chains, level)
  if level == 0 then return {frequencies = zero, loads = zero} end
  local frequencies, loads = {}, {}
  for i, chain in ipairs(chains) do
    local certificate = s.info(chain).levels[level + 1].certificate
    frequencies[i] = percent * rms_of_frequencies(certificate)
    loads[i] = percent * certificate.held_out_load_error
  end
  return {frequencies = intervals.mean(frequencies), loads = intervals.mean(loads)}
end

return pareto_chains
