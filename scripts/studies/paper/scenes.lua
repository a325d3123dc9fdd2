-- The bodies and scenes of the paper as functions of their parameters. The paper does not specify
-- materials, friction and floor; docs/paper.md explains the values used here.

local s = require "springlod"

local paper_scenes = {}

local cell = 0.1 -- cell size of all bodies [m]

-- Fills missing options from `defaults`. An option without a default is an error.
local function with_defaults(options, defaults)
  local complete = {}
  for name, value in pairs(defaults) do complete[name] = value end
  for name, value in pairs(options or {}) do
    if defaults[name] == nil then error("unknown parameter '" .. name .. "'", 3) end
    complete[name] = value
  end
  return complete
end

local function sample(name) return dofile(s.samples .. "/" .. name .. ".lua") end

-- Bodies: models with a node at the center of each cell, as in the paper. `volumes` is that of
-- s.lattice; the paper's models have no corners.

-- The `count` cells closest to a point slightly off a cell center. Cells within `core_radius` cells
-- of that point are core, the others shell.
function paper_scenes.ball(options)
  local o = with_defaults(options, {
    count = 281, core_radius = 2.3, materials = sample("ball_materials"), volumes = false,
  })
  local reach = math.ceil((o.count * 3 / (4 * math.pi)) ^ (1 / 3)) + 1 -- [cells]
  local points = {}
  for z = -reach, reach do
    for y = -reach, reach do
      for x = -reach, reach do
        local distance = math.sqrt((x - 0.04) ^ 2 + (y - 0.02) ^ 2 + (z - 0.01) ^ 2)
        points[#points + 1] = {distance = distance, order = #points, x = x, y = y, z = z}
      end
    end
  end
  table.sort(points, function(a, b)
    if a.distance ~= b.distance then return a.distance < b.distance end
    return a.order > b.order
  end)
  local function key(x, y, z) return ("%d %d %d"):format(x, y, z) end
  local material = {}
  for i = 1, o.count do
    local p = points[i]
    material[key(p.x, p.y, p.z)] = p.distance <= o.core_radius and "core" or "shell"
  end
  local function nearest(x) return math.floor(x / cell + 0.5) end
  local corner = -(reach + 0.5) * cell
  local grid = s.grid{
    cell = cell, size = {2 * reach + 1, 2 * reach + 1, 2 * reach + 1},
    origin = {corner, corner, corner}, materials = o.materials,
    fill = function(x, y, z) return material[key(nearest(x), nearest(y), nearest(z))] end,
  }
  return s.lattice(grid, {style = "centers", volumes = o.volumes}), grid
end

-- Two stiff rods of `width` x `width` x `rod` cells, joined by `joint` cells of rubber.
function paper_scenes.rods(options)
  local o = with_defaults(options, {
    width = 4, rod = 9, joint = 5, materials = sample("dumbbell_materials"), volumes = false,
  })
  local length = 2 * o.rod + o.joint
  local grid = s.grid{
    cell = cell, size = {o.width, o.width, length},
    origin = {-o.width * cell / 2, -o.width * cell / 2, -length * cell / 2},
    materials = o.materials,
    fill = function(_, _, z)
      return math.abs(z) < o.joint * cell / 2 and "rubber" or "rod"
    end,
  }
  return s.lattice(grid, {style = "centers", volumes = o.volumes}), grid
end

-- A block of one material with `size` nodes along the axes; default: the paper's cube.
function paper_scenes.block(options)
  local o = with_defaults(options, {
    size = {6, 6, 6},
    material = {young = "1 MPa", density = 1000, damping = "2 ms", colour = "#b08d57"},
    volumes = false,
  })
  local origin = {}
  for axis, count in ipairs(o.size) do origin[axis] = -count * cell / 2 end
  local grid = s.grid{
    cell = cell, size = o.size, origin = origin, materials = {body = o.material},
    fill = function() return "body" end,
  }
  return s.lattice(grid, {style = "centers", volumes = o.volumes}), grid
end

-- Scenes: tables for s.scenario.

-- Scenario 1: the body is thrown horizontally just above a floor and rolls until it stops.
-- Measured: distance travelled.
function paper_scenes.roll(options)
  local o = with_defaults(options, {
    speed = 3.2, height = 0.6, friction = 0.5, floor_stiffness = 1e6, duration = 12,
    stop_speed = 0.1,
  })
  return {
    name = "roll", duration = o.duration,
    throw = {position = {0, 0, o.height}, velocity = {o.speed, 0, 0}},
    obstacles = {{
      name = "floor", plane = {0, 0, 1, 0}, stiffness = o.floor_stiffness, friction = o.friction,
    }},
    stop = {speed = o.stop_speed},
  }
end

-- Scenario 2: the body is thrown at a wall, upright and spinning end over end, bounces off and
-- comes to rest. Measured: distance from the wall.
function paper_scenes.wall(options)
  local o = with_defaults(options, {
    speed = 10, spin = 6, height = 2, wall_distance = 2, friction = 0.5, floor_stiffness = 2e6,
    duration = 5,
  })
  local function obstacle(name, plane)
    return {name = name, plane = plane, stiffness = o.floor_stiffness, friction = o.friction}
  end
  return {
    name = "throw at a wall", duration = o.duration, measure_from = "wall",
    throw = {
      position = {-o.wall_distance, 0, o.height}, velocity = {o.speed, 0, 0},
      spin = {0, o.spin, 0},
    },
    obstacles = {obstacle("floor", {0, 0, 1, 0}), obstacle("wall", {-1, 0, 0, 0})},
  }
end

-- The counter-example of section 6 of the paper, a thrown die: a tilted cube is dropped. Measured:
-- horizontal displacement.
function paper_scenes.die(options)
  local o = with_defaults(options, {
    height = 1.5, speed = 1, tilt = 25, friction = 0.5, floor_stiffness = 2e6, duration = 4,
  })
  return {
    name = "die", duration = o.duration,
    throw = {
      position = {0, 0, o.height}, velocity = {o.speed, 0, 0},
      turn = {axis = {1, 0.4, 0}, angle = ("%g deg"):format(o.tilt)},
    },
    obstacles = {{
      name = "floor", plane = {0, 0, 1, 0}, stiffness = o.floor_stiffness, friction = o.friction,
    }},
  }
end

return paper_scenes
