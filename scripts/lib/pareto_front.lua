-- Which of many points nothing else beats in cost and error both.

-- `points` are tables with `x` and `y`, less being better; returns those of the front by rising x.
return function(points)
  local sorted = table.move(points, 1, #points, 1, {})
  table.sort(sorted, function(p, q)
    if p.x ~= q.x then return p.x < q.x end
    return p.y < q.y
  end)
  local front, least = {}, math.huge
  for _, point in ipairs(sorted) do
    if point.y < least then
      front[#front + 1] = point
      least = point.y
    end
  end
  return front
end
