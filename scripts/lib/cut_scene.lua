-- A scene's table cut to `duration` [s]; runs of it go on to its end, at rest or not.

return function(scene, duration)
  local copy = {}
  for key, value in pairs(scene) do copy[key] = value end
  copy.duration, copy.stop = duration, nil
  return copy
end
