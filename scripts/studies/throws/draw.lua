-- Draws the parameters of a throw. They depend on the seed and on the number of the throw alone.

local random = require "studies.throws.random"
local shapes = require "studies.throws.shapes"

local density = 1000 -- [kg/m3], of all materials

-- Where the stiff material of a body of two materials is: beyond a plane, in the core or around it.
local function draw_layout(size)
  local direction = random.direction()
  local core = 0.6 -- of the half axes of the ellipsoid in the box of the body
  local function in_core(x, y, z)
    return (x / size[1]) ^ 2 + (y / size[2]) ^ 2 + (z / size[3]) ^ 2 < (core / 2) ^ 2
  end
  return random.one_of{
    {name = "stiff half", stiff = function(x, y, z)
      return x * direction[1] + y * direction[2] + z * direction[3] > 0
    end},
    {name = "stiff core", stiff = in_core},
    {name = "stiff shell", stiff = function(x, y, z) return not in_core(x, y, z) end},
  }
end

local function draw_body(throw, cells)
  local shape = random.one_of(shapes)(cells)
  throw.shape, throw.size, throw.inside = shape.name, shape.size, shape.inside
  throw.cell = random.chance(0.5) and 0.01 or random.log_uniform(0.002, 0.1)
  throw.young, throw.density, throw.ratio = random.log_uniform(5e4, 1e7), density, 1
  if shape.stiff or random.chance(0.5) then
    local layout = shape.stiff and {name = "stiff ends", stiff = shape.stiff}
      or draw_layout(shape.size)
    throw.layout, throw.stiff = layout.name, layout.stiff
    throw.ratio = random.log_uniform(1, 100)
  else
    throw.layout, throw.stiff = "one material", function() return false end
  end
  throw.wave_speed = math.sqrt(throw.young / density) -- the slowest, of a long wave in a bar
end

local function draw_model(throw)
  local kind = math.random()
  throw.base = kind < 0.45 and "corners" or kind < 0.8 and "centers" or "random"
  throw.grouping = random.one_of{"standard", "compact"}
  throw.contact = random.one_of{"nodes", "surface"}
end

local function draw_scene(throw)
  throw.speed = random.log_uniform(1, 15)
  -- At most 73 degrees from the vertical, so that the body is soon at the floor.
  local down, azimuth = random.uniform(0.3, 1), random.uniform(0, 2 * math.pi)
  throw.azimuth = azimuth
  local across = math.sqrt(1 - down * down)
  throw.direction = {across * math.cos(azimuth), across * math.sin(azimuth), -down}
  throw.turn = {axis = random.direction(), angle = random.uniform(0, math.pi)}
  throw.spin_axis, throw.spin = random.direction(), random.uniform(0, 20)
  throw.stiffness = random.chance(0.5) and "auto" or random.log_uniform(1e6, 1e9)
  throw.friction = random.uniform(0, 1)
  throw.wall = random.chance(1 / 3)
  throw.wall_gap = random.uniform(0, 5) -- [cells], beyond that to the floor
  throw.wall_turn = random.uniform(-0.7, 0.7) -- from facing the throw [rad]
end

-- `cells`: the fewest and the most cells of a body, and the most of a small one. Bodies that take
-- longer than others with as many cells, because they are fitted or integrated with other schemes,
-- are small.
return function(seed, number, cells)
  random.start(seed, number)
  local throw = {number = number, integrator = "symplectic_euler", precision = "double"}
  throw.fitted = random.chance(0.25)
  if random.chance(0.1) then
    throw.integrator = random.one_of{"velocity_verlet", "runge_kutta_4"}
  elseif random.chance(0.5) then
    throw.precision = "single"
  end
  local small = throw.fitted or throw.integrator ~= "symplectic_euler"
  draw_body(throw, random.log_uniform(cells.fewest, small and cells.small or cells.most))
  draw_model(throw)
  draw_scene(throw)
  return throw
end
