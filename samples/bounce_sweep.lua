-- A sweep of 1,000 runs: a ball of some Young's modulus and Poisson's ratio falls on a floor from
-- some height, as its base or one of its levels. How high does it bounce?
--   springlod sweep plan samples/bounce_sweep.lua --out out/bounce
--   springlod sweep run out/bounce
--   springlod sweep merge out/bounce

local s = require "springlod"

local radius, gravity, across = 0.05, 9.81, 16 -- cells across the ball
local levels, moduli = {0, 1, 2, 3}, {1e5, 2e5, 5e5, 1e6, 2e6}

local heights = {}
for i = 1, 10 do heights[i] = i / 20 end

-- The chain of a ball. Units of the same ball follow each other, so the last one is kept.
local last = {}
local function chain_of(young, poisson)
  if last.young ~= young or last.poisson ~= poisson then
    local ball = s.grid{
      cell = 2 * radius / across, size = {across, across, across}, origin = {-radius, -radius, 0},
      materials = {rubber = {young = young, poisson = poisson, density = 1100,
                             damping_ratio = 0.02}},
      fill = function(x, y, z)
        return x ^ 2 + y ^ 2 + (z - radius) ^ 2 < radius ^ 2 and "rubber" or nil
      end,
    }
    last = {young = young, poisson = poisson, chain = s.simplify(s.lattice(ball),
      {keep = {0.5, 0.3, 0.15}, grouping = "compact", seed = 1})}
  end
  return last.chain
end

local function duration_of(height) return 2.2 * math.sqrt(2 * height / gravity) + 0.05 end

-- How high the ball comes again, and when: the highest place of its center of mass after the
-- lowest one, over that of a ball that stands on the floor.
local function bounce(point)
  local level = chain_of(point.young, point.poisson)[point.level]
  local run = s.run(level, s.scenario{
    duration = duration_of(point.height), throw = {position = {0, 0, radius + point.height}},
    obstacles = {{plane = {0, 0, 1, 0}, friction = 0.5}},
  }, {quiet = true, frame_rate = 500})
  local energies, weight = run.ledger, level.mass * gravity
  local lowest, highest = energies[1], nil
  for _, entry in ipairs(energies) do
    if entry.gravity < lowest.gravity then
      lowest, highest = entry, nil
    elseif not highest or entry.gravity > highest.gravity then
      highest = entry
    end
  end
  return {
    nodes = level.node_count, first_contact = run.first_contact, apex = highest.time,
    bounce = point.height + (highest.gravity - energies[1].gravity) / weight,
  }
end

-- Draws the mean share of the height that each level keeps, over Young's modulus.
local function report(results, folder)
  local sums = {}
  for _, row in ipairs(results.rows) do
    local key = row.level .. " " .. row.young
    sums[key] = sums[key] or {young = row.young, level = row.level, share = 0, count = 0}
    sums[key].share = sums[key].share + row.bounce / row.height
    sums[key].count = sums[key].count + 1
  end
  local series = {}
  for i, level in ipairs(levels) do
    series[i] = {name = level == 0 and "base" or "level " .. level, points = {}}
    for _, young in ipairs(moduli) do
      local sum = sums[level .. " " .. young]
      if sum then table.insert(series[i].points, {young, sum.share / sum.count}) end
    end
  end
  s.chart(folder .. "/bounce.svg", series, {
    title = ("How high balls bounce (%d of %d runs)"):format(#results.rows,
      #results.rows + #results.gaps),
    x_label = "Young's modulus [Pa]", y_label = "height after the bounce / before it",
    log_x = true,
  })
end

return s.sweep{
  axes = {
    {"young", moduli},
    {"poisson", {0.25, 0.3, 0.35, 0.4, 0.45}},
    {"level", levels},
    {"height", heights},
  },
  columns = {"nodes", "first_contact", "bounce", "apex"},
  cost = function(point)
    local level = chain_of(point.young, point.poisson)[point.level]
    return level.spring_count * duration_of(point.height) / s.stable_step(level)
  end,
  unit = bounce,
  report = report,
}
