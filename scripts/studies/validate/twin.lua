-- A problem with some of its fields changed.
return function(problem, changes)
  local twin = {}
  for key, value in pairs(problem) do twin[key] = value end
  for key, value in pairs(changes) do twin[key] = value end
  return twin
end
