-- The bodies and scenes of the paper as functions of their parameters. Materials, friction and
-- floor are ours, for the paper gives none: see docs/paper.md.

local s = require "springlod"

local paper_scenes = {}

local cell = 0.1 -- edge of all bodies' cells [m]

-- The options with what is missing taken from `usual`; a name that `usual` lacks is a mistake.
local function with_defaults(options, usual)
  local complete = {}
  for name, value in pairs(usual) do complete[name] = value end
  for name, value in pairs(options or {}) do
    if usual[name] == nil then error("there is no parameter '" .. name .. "'", 3) end
    complete[name] = value
  end
  return complete
end

local function sample(name) return dofile(s.samples .. "/" .. name .. ".lua") end

-- Bodies: a model with a node at the centre of each cell, as in the paper.

-- The `count` lattice points nearest to a point a little off a lattice point, those within
-- `core_radius` cells of it core, the others shell.
function paper_scenes.ball(options)
  local o = with_defaults(options, {
    count = 281, core_radius = 2.3, materials = sample("ball_materials"),
  })
  local reach = math.ceil((o.count * 3 / (4 * math.pi)) ^ (1 / 3)) + 1 -- cells from the middle
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
  local part = {}
  for i = 1, o.count do
    local p = points[i]
    part[key(p.x, p.y, p.z)] = p.distance <= o.core_radius and "core" or "shell"
  end
  local function nearest(x) return math.floor(x / cell + 0.5) end
  local corner = -(reach + 0.5) * cell
  local grid = s.grid{
    cell = cell, size = {2 * reach + 1, 2 * reach + 1, 2 * reach + 1},
    origin = {corner, corner, corner}, materials = o.materials,
    fill = function(x, y, z) return part[key(nearest(x), nearest(y), nearest(z))] end,
  }
  return s.lattice(grid, {style = "centers"}), grid
end

-- Two stiff rods of `width` x `width` x `rod` cells and `joint` cells of rubber between them.
function paper_scenes.rods(options)
  local o = with_defaults(options, {
    width = 4, rod = 9, joint = 5, materials = sample("dumbbell_materials"),
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
  return s.lattice(grid, {style = "centers"}), grid
end

-- A block of one material, `size` nodes along each axis: the paper's cube if left out.
function paper_scenes.block(options)
  local o = with_defaults(options, {
    size = {6, 6, 6},
    material = {young = "1 MPa", density = 1000, damping = "2 ms", colour = "#b08d57"},
  })
  local origin = {}
  for axis, count in ipairs(o.size) do origin[axis] = -count * cell / 2 end
  local grid = s.grid{
    cell = cell, size = o.size, origin = origin, materials = {body = o.material},
    fill = function() return "body" end,
  }
  return s.lattice(grid, {style = "centers"}), grid
end

-- Scenes: a table for s.scenario.

-- Scenario 1: thrown flat just above a floor, rolls until it stops; how far it got.
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

-- Scenario 2: thrown at a wall, upright and turning end over end, bounces off and comes to rest;
-- how far from the wall.
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

-- The counter-example of the paper's section 6: a cube dropped askew, a thrown die. Measured: how
-- far it has gone sideways.
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
