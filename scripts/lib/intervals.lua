-- Means and medians of small samples with their intervals: {value =, low =, high =}.

local s = require "springlod"

local intervals = {}

local least_resampled = 5 -- smallest sample of s.statistics
local confidence = 0.95

local function sorted(values)
  local copy = table.move(values, 1, #values, 1, {})
  table.sort(copy)
  return copy
end

-- The mean of a sample with its bootstrap interval. Samples of fewer than five numbers get their
-- range instead.
function intervals.mean(values)
  if #values >= least_resampled then
    local m = s.statistics(values)
    return {value = m.mean, low = m.mean_low, high = m.mean_high}
  end
  local list = sorted(values)
  return {value = s.mean(list), low = list[1], high = list[#list]}
end

-- How many of n sorted numbers can be dropped at either end so that the range of the others
-- contains the median of their distribution with at least 95 % confidence (sign test; it assumes
-- nothing about the distribution).
local function trimmed(n)
  -- Binomial distribution: probability that exactly `count` numbers lie below the median.
  local probability, below, count = 0.5 ^ n, 0, 0
  while count < n / 2 do
    below = below + probability
    if below > (1 - confidence) / 2 then break end
    probability, count = probability * (n - count) / (count + 1), count + 1
  end
  return math.max(0, count - 1)
end

-- The median with its sign-test interval. Fewer than six numbers get their range, whose confidence
-- is below 95 %.
function intervals.median(values)
  local list = sorted(values)
  local n, out = #list, trimmed(#list)
  return {value = (list[(n + 1) // 2] + list[n // 2 + 1]) / 2, low = list[1 + out],
          high = list[n - out]}
end

-- Least, median and largest number of a sample, as a text.
function intervals.spread(values)
  local list = sorted(values)
  return ("%.2f, %.2f, %.2f"):format(list[1], intervals.median(list).value, list[#list])
end

return intervals
