-- Which of many points nothing else beats in cost and error both.

-- An error less by no more than this part is no gain: single and double precision differ by less.
local least_gain = 0.01

-- `points` are tables with `x` and `y`, less being better; errors up to `alike` are all the same.
-- Returns those of the front by rising x.
return function(points, alike)
  local function error_of(point) return math.max(point.y, alike) end
  local sorted = table.move(points, 1, #points, 1, {})
  table.sort(sorted, function(p, q)
    if p.x ~= q.x then return p.x < q.x end
    return p.y < q.y
  end)
  local front, least = {}, math.huge
  for _, point in ipairs(sorted) do
    if #front == 0 or error_of(point) < (1 - least_gain) * least then
      front[#front + 1] = point
      least = error_of(point)
    end
  end
  return front
end
