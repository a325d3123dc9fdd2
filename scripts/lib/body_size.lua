-- Diagonal of the bounding box of the nodes of a model [m].

return function(model)
  local low, high = {math.huge, math.huge, math.huge}, {-math.huge, -math.huge, -math.huge}
  for _, node in ipairs(model:nodes()) do
    for d, x in ipairs{node.x, node.y, node.z} do
      low[d], high[d] = math.min(low[d], x), math.max(high[d], x)
    end
  end
  return math.sqrt((high[1] - low[1]) ^ 2 + (high[2] - low[2]) ^ 2 + (high[3] - low[3]) ^ 2)
end
