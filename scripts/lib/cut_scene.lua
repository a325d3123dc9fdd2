-- A copy of a scene table that lasts `duration` [s]. It has no rest criterion: every run goes to
-- the end.

return function(scene, duration)
  local copy = {}
  for key, value in pairs(scene) do copy[key] = value end
  copy.duration, copy.stop = duration, nil
  return copy
end
