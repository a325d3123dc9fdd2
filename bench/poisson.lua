-- What a Poisson's ratio costs: time and length of a step, over those at 1/4 (docs/models.md).
--   springlod run bench/poisson.lua [-- CELLS]
local s = require "springlod"

local cells = tonumber(arg[1]) or 16
local steps, turns = 400, 5 -- of a timed run; timed runs, of which the fastest counts

local function block(poisson, damping)
  return s.lattice(s.grid{
    cell = "1 cm", size = {cells, cells, cells}, fill = function() return "soft" end,
    materials = {soft = {young = "1 MPa", density = 1000, damping = damping, poisson = poisson}}})
end

local function merged(poisson)
  local chain = s.simplify(block(poisson, "0.2 ms"),
    {levels = 1, keep = {0.42}, grouping = "compact"})
  return chain:level(1)
end

-- Processor time of a step in free flight [s].
local function step_time(model, precision)
  local step = s.stable_step(model) / 2
  local scene = s.scenario{
    duration = steps * step, gravity = {0, 0, 0}, throw = {spin = {1, 2, 3}}}
  local how = {step = step, precision = precision, ledger = false, frame_rate = 0}
  local best = math.huge
  for _ = 1, turns do
    local run = s.run(model, scene, how)
    best = math.min(best, run.processor_seconds / run.steps)
  end
  return best
end

print(("time of a step at 0.45 over that at 1/4, %d^3 cells"):format(cells))
for _, precision in ipairs{"double", "single"} do
  local function ratio(model)
    return step_time(model(0.45), precision) / step_time(model(0.25), precision)
  end
  local function lattice(poisson) return block(poisson, "0.2 ms") end
  print(("  %s: lattice %.2f, merged level %.2f"):format(
    precision, ratio(lattice), ratio(merged)))
end

print("stable step without damping, over that at 1/4")
local usual = s.stable_step(block(0.25, 0))
for _, poisson in ipairs{-0.2, 0, 0.25, 0.4, 0.45, 0.49, 0.495} do
  print(("  %6.3f: %.2f"):format(poisson, s.stable_step(block(poisson, 0)) / usual))
end
