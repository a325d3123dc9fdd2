-- The scenes of the picks study, for a body of diagonal `d` [m] whose slowest mode has the
-- frequency `f` [Hz]. Lengths and speeds follow the size of the body.

local function speed(d, height) return math.sqrt(2 * 9.81 * height * d) end

local function plane(x, y, z, friction, stiffness)
  return {plane = {x, y, z, 0}, friction = friction, stiffness = stiffness}
end

local function turn(x, y, z, angle) return {axis = {x, y, z}, angle = angle .. " deg"} end

local function scene(duration, position, more, obstacles)
  local throw = {position = position}
  for key, value in pairs(more) do throw[key] = value end
  return {duration = duration, throw = throw, obstacles = obstacles}
end

local tuning = {
  {"drop", function(d)
    return scene(0.6 + d ^ 0.5, {0, 0, 1.1 * d}, {turn = turn(1, 0.4, 0.2, 25)},
      {plane(0, 0, 1, 0.5)})
  end},
  {"throw", function(d)
    local v = speed(d, 1.5)
    return scene(0.8 + d ^ 0.5, {0, 0, 0.8 * d}, {turn = turn(0, 1, 0.3, 50),
      velocity = {v, 0.2 * v, 0}, spin = {0.5 * v / d, 2 * v / d, 0}}, {plane(0, 0, 1, 0.6)})
  end},
  {"incline", function(d)
    return scene(1.2, {-0.205 * d, 0, 0.564 * d}, {}, {plane(-0.342, 0, 0.94, 0.8)})
  end},
  {"flight", function(d, f)
    return scene(0.5 * d ^ 0.5 + 10 / f, {0, 0, 10}, {spin = {f, 0.4 * f, 0.2 * f}})
  end},
  {"wall", function(d)
    local v = speed(d, 3)
    return scene(0.8 + d ^ 0.5, {-1.2 * d, 0, 0.9 * d}, {turn = turn(0, 1, 0, 70),
      velocity = {v, 0, 0}, spin = {0, 1.2 * v / d, 0.3 * v / d}},
      {plane(0, 0, 1, 0.5), plane(-1, 0, 0, 0.3)})
  end},
  {"flat drop", function(d)
    return scene(0.6 + d ^ 0.5, {0, 0, 0.9 * d}, {}, {plane(0, 0, 1, 0.5)})
  end},
}

local checking = {
  {"hard drop", function(d)
    return scene(0.8 + d ^ 0.5, {0, 0, 2.5 * d}, {turn = turn(0.3, 1, 0, 60), spin = {2, 0, 3}},
      {plane(0, 0, 1, 0.4)})
  end},
  {"skid", function(d)
    return scene(1, {0, 0, 0.65 * d}, {turn = turn(1, 0, 0, 15), velocity = {speed(d, 2), 0, 0}},
      {plane(0, 0, 1, 0.2)})
  end},
  {"steep incline", function(d)
    return scene(1.2, {-0.25 * d, 0, 0.783 * d}, {turn = turn(0, 1, 0, 20), spin = {0, 3, 0}},
      {plane(-0.5, 0, 0.866, 1)})
  end},
  {"tumble", function(d, f)
    return scene(0.4 * d ^ 0.5 + 15 / f, {0, 0, 10}, {spin = {0.2 * f, 0.7 * f, 0.5 * f}})
  end},
  {"mat", function(d)
    local v = speed(d, 2)
    return scene(0.8 + d ^ 0.5, {0, 0, 1.2 * d}, {turn = turn(1, 1, 0, 35),
      velocity = {0.3 * v, 0, -0.5 * v}, spin = {0, 1, 0}}, {plane(0, 0, 1, 0.7, 5e6)})
  end},
  {"edge of a box", function(d)
    return scene(0.8 + d ^ 0.5, {0.15 * d, 0, 1.3 * d}, {turn = turn(0, 1, 0, 10)},
      {plane(0, 0, 1, 0.5), {friction = 0.5,
        box = {center = {-0.5 * d, 0, 0.15 * d}, size = {d, 3 * d, 0.3 * d}}}})
  end},
}

return {tuning = tuning, checking = checking}
