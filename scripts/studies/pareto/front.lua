-- The Pareto front of points in cost and error.

-- Relative reduction of the error that counts as a gain; single and double precision differ by
-- less.
local least_gain = 0.01

-- `points`: tables with `x` and `y`, both to be minimized; values of y up to `floor` count as
-- equal. Returns the points of the front, sorted by x.
return function(points, floor)
  local function error_of(point) return math.max(point.y, floor) end
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
