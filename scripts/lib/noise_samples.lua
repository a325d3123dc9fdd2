-- Samples of the base for s.noise_floor, as options of s.ensemble: other starts, half the time
-- step, another integrator. The samples use starts after the first `starts`, each start once.

local sources = {
  {name = "other-starts", times = 2},
  {name = "half-step", times = 1, safety = 0.4},
  {name = "velocity-verlet", times = 1, integrator = "velocity_verlet"},
}

return function(starts)
  local list, first = {}, starts + 1
  for i, source in ipairs(sources) do
    list[i] = {name = source.name, options = {
      first = first, starts = source.times * starts, safety = source.safety,
      integrator = source.integrator,
    }}
    first = first + source.times * starts
  end
  return list
end
