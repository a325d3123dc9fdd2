-- Transposes seeds[seed][start] to starts[start][seed], the layout that s.statistics and
-- s.compare_samples take.

return function(seeds)
  local list = {}
  for start = 1, #seeds[1] do
    list[start] = {}
    for seed = 1, #seeds do list[start][seed] = seeds[seed][start] end
  end
  return list
end
