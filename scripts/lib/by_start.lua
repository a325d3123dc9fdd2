-- A list of numbers a seed as s.statistics and s.compare_samples take it: a list a start of one
-- number a seed.

return function(seeds)
  local list = {}
  for start = 1, #seeds[1] do
    list[start] = {}
    for seed = 1, #seeds do list[start][seed] = seeds[seed][start] end
  end
  return list
end
