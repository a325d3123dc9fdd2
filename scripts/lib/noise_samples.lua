-- How far the base is from itself: other starts, and what a method's own error does. Samples for
-- s.noise_floor beside one of `starts` starts, as options of s.ensemble; no start is used twice.

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
