-- Values with an interval, {value =, low =, high =}, of few numbers.

local s = require "springlod"

local intervals = {}

local least_resampled = 5 -- what s.statistics takes
local confidence = 0.95

local function sorted(values)
  local copy = table.move(values, 1, #values, 1, {})
  table.sort(copy)
  return copy
end

-- The mean of a sample with the interval that resampling gives it; of fewer than five numbers, one
-- a seed or start, their range in its place.
function intervals.mean(values)
  if #values >= least_resampled then
    local m = s.statistics(values)
    return {value = m.mean, low = m.mean_low, high = m.mean_high}
  end
  local list = sorted(values)
  return {value = s.mean(list), low = list[1], high = list[#list]}
end

-- How many of n numbers may be left out at either end so that the rest still holds the median of
-- what they are drawn from with at least 95 % confidence, whatever its distribution (sign test).
local function trimmed(n)
  local chance, below, count = 0.5 ^ n, 0, 0 -- binomial: of `count` numbers below the median
  while count < n / 2 do
    below = below + chance
    if below > (1 - confidence) / 2 then break end
    chance, count = chance * (n - count) / (count + 1), count + 1
  end
  return math.max(0, count - 1)
end

-- The median with an interval of the numbers' own; of fewer than six their range, which holds it
-- with less than 95 %.
function intervals.median(values)
  local list = sorted(values)
  local n, out = #list, trimmed(#list)
  return {value = (list[(n + 1) // 2] + list[n // 2 + 1]) / 2, low = list[1 + out],
          high = list[n - out]}
end

return intervals
