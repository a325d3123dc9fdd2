-- Mean and standard deviation of a list of numbers of any length; s.statistics, which adds
-- intervals, needs at least five.

local averages = {}

function averages.mean(list)
  local sum = 0
  for _, value in ipairs(list) do sum = sum + value end
  return sum / #list
end

function averages.standard_deviation(list)
  local middle, sum = averages.mean(list), 0
  for _, value in ipairs(list) do sum = sum + (value - middle) ^ 2 end
  return math.sqrt(sum / (#list - 1))
end

return averages
