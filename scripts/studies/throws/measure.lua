-- Builds the body of a throw and throws it at every level.

local s = require "springlod"
local command = require "lib.command"

local measure = {}

local frames = 100 -- of the ledger, in each run
local longest = 1.5 -- simulated time [s]
local crossings = 4 -- times a wave crosses the body at the slowest speed: the blow and the rebound
local clearance = 1.5 -- between the outermost nodes and the obstacles at the start [cells]

local function make_chain(throw)
  local function at(position) return position / throw.cell end
  local origin = {}
  for axis = 1, 3 do origin[axis] = -throw.size[axis] * throw.cell / 2 end
  local grid = s.grid{
    cell = throw.cell, size = throw.size, origin = origin,
    materials = {
      soft = {young = throw.young, density = throw.density},
      stiff = {young = throw.young * throw.ratio, density = throw.density},
    },
    fill = function(x, y, z)
      x, y, z = at(x), at(y), at(z)
      if not throw.inside(x, y, z) then return nil end
      return throw.stiff(x, y, z) and "stiff" or "soft"
    end,
  }
  throw.cells = grid.cell_count
  local base
  if throw.base == "random" then
    base = s.random(grid, {seed = throw.number})
  else
    base = s.lattice(grid, {style = throw.base, hinges = "fill"})
  end
  return s.simplify(base, {
    levels = 2, grouping = throw.grouping, seed = throw.number,
    calibrate = throw.fitted and "modes" or "none",
  })
end

-- Turns a vector by `turn` (Rodrigues' formula for the unit vector turn.axis).
local function turned(v, turn)
  local a, cosine, sine = turn.axis, math.cos(turn.angle), math.sin(turn.angle)
  local along = (a[1] * v[1] + a[2] * v[2] + a[3] * v[3]) * (1 - cosine)
  return {
    v[1] * cosine + (a[2] * v[3] - a[3] * v[2]) * sine + a[1] * along,
    v[2] * cosine + (a[3] * v[1] - a[1] * v[3]) * sine + a[2] * along,
    v[3] * cosine + (a[1] * v[2] - a[2] * v[1]) * sine + a[3] * along,
  }
end

-- How far the turned body reaches from its centre of mass along a unit vector [m].
local function reach(base, turn, direction)
  local center, most = base.center, 0
  for _, node in ipairs(base:nodes()) do
    local v = turned({node.x - center[1], node.y - center[2], node.z - center[3]}, turn)
    most = math.max(most, v[1] * direction[1] + v[2] * direction[2] + v[3] * direction[3])
  end
  return most
end

local function scaled(v, factor) return {v[1] * factor, v[2] * factor, v[3] * factor} end

-- The scenario: a floor at height 0 and, for some throws, a box in the way.
local function make_scene(throw, base)
  local gap = clearance * throw.cell
  local center = {0, 0, reach(base, throw.turn, {0, 0, -1}) + gap}
  local function obstacle(name, kind, value)
    return {name = name, [kind] = value, stiffness = throw.stiffness, friction = throw.friction}
  end
  local obstacles = {obstacle("floor", "plane", {0, 0, 1, 0})}
  local way = gap / -throw.direction[3] -- to the obstacles, along the path
  local size = base.bounds.diagonal
  if throw.wall then
    local azimuth = throw.azimuth + throw.wall_turn
    local normal = {math.cos(azimuth), math.sin(azimuth), 0} -- into the box
    local thickness = 2 * size
    local beyond = throw.wall_gap * throw.cell
    local face = reach(base, throw.turn, normal) + gap + beyond
    obstacles[2] = obstacle("wall", "box", {
      center = scaled(normal, face + thickness / 2),
      size = {thickness, 10 * size, 10 * size},
      turn = {angle = azimuth},
    })
    way = way + beyond
  end
  return s.scenario{
    name = "throw " .. throw.number, obstacles = obstacles,
    duration = math.min(longest, crossings * size / throw.wave_speed + way / throw.speed),
    throw = {
      position = center, velocity = scaled(throw.direction, throw.speed), turn = throw.turn,
      spin = scaled(throw.spin_axis, throw.spin),
    },
  }
end

-- The largest deviation of an entry of the ledger from its start, over the largest kinetic energy.
local function deviation(ledger, name)
  local gap, kinetic = 0, 0
  for _, entry in ipairs(ledger) do
    gap = math.max(gap, math.abs(entry[name] - ledger[1][name]))
    kinetic = math.max(kinetic, entry.kinetic)
  end
  return kinetic > 0 and gap / kinetic or 0
end

-- Volume of all corners in a state over that at rest; "" without corners.
local function volume_ratio(model, x)
  local sum, at_rest = 0, 0
  for _, corner in ipairs(model:corners()) do
    local nodes = corner.nodes
    local o, a, b, c = x[nodes[1]], x[nodes[2]], x[nodes[3]], x[nodes[4]]
    local ax, ay, az = a[1] - o[1], a[2] - o[2], a[3] - o[3]
    local bx, by, bz = b[1] - o[1], b[2] - o[2], b[3] - o[3]
    local cx, cy, cz = c[1] - o[1], c[2] - o[2], c[3] - o[3]
    sum = sum + ax * (by * cz - bz * cy) + ay * (bz * cx - bx * cz) + az * (bx * cy - by * cx)
    at_rest = at_rest + corner.volume
  end
  return at_rest > 0 and sum / at_rest or ""
end

-- Calls work(...) and returns its results, or nil and the error if it is one of springlod. Other
-- errors are bugs of this script.
local function attempt(work, ...)
  local ok, result = pcall(work, ...)
  if ok then return result end
  if type(result) ~= "userdata" or not result.kind then error(result, 0) end
  command.reason(result) -- throws if interrupted
  return nil, result
end

local function run_level(model, scene, throw, options)
  local how = {
    integrator = throw.integrator, contact = throw.contact, quiet = true, ledger = true,
    frame_rate = frames / scene.duration,
    precision = throw.precision,
  }
  for name, value in pairs(options) do how[name] = value end
  return s.run(model, scene, how)
end

local function failed(row, failure)
  row.error, row.message = failure.kind, failure.message
  return row
end

local function measured(row, model, run)
  row.inverted_at_end, row.most_inverted = run.inverted_at_end, run.most_inverted
  row.first_inversion = run.first_inversion and run.first_inversion.time or ""
  row.ledger_error = deviation(run.ledger, "total")
  row.scheme_error = deviation(run.ledger, "lost_scheme")
  row.simulated, row.steps, row.spring_updates = run.simulated, run.steps, run.spring_updates
  row.step, row.shortest_step = run.step, run.shortest_step
  row.volume_ratio = volume_ratio(model, run.final.x)
  return row
end

-- Throws the body at every level: a list of rows, of which those of failed runs have the fields
-- error and message. A body that cannot be built has one row, without a level. `options`: of s.run;
-- visit(row, model, run), if given, is called after each completed run.
function measure.throw(throw, options, visit)
  local chain, failure = attempt(make_chain, throw)
  if not chain then return {failed({}, failure)} end
  local scene, rows = make_scene(throw, chain[0]), {}
  for level = 0, chain.coarsest do
    local model = chain[level]
    local row = {level = level, nodes = model.node_count,
                 springs = model.spring_count, corners = model.corner_count}
    local run
    run, failure = attempt(run_level, model, scene, throw, options)
    rows[level + 1] = run and measured(row, model, run) or failed(row, failure)
    if run and visit then visit(row, model, run) end
  end
  return rows
end

return measure
