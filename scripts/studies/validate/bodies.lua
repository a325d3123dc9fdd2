-- What the bodies of the validation have in common.

local s = require "springlod"
local ball_mesh = require "studies.validate.ball_mesh"

local bodies = {}

bodies.material = {young = 1e6, density = 1000, damping = 0}
bodies.poisson = 0.25 -- of springs alone
-- Speeds of waves [m/s]: shear waves, and longitudinal waves in a thin bar.
bodies.shear_speed = math.sqrt(bodies.material.young / (2 * (1 + bodies.poisson))
  / bodies.material.density)
bodies.bar_speed = math.sqrt(bodies.material.young / bodies.material.density)

-- A box of `size` [m] with `cells` cells per metre.
function bodies.box(size, cells)
  return s.lattice(s.grid{
    cell = 1 / cells, size = {size[1] * cells, size[2] * cells, size[3] * cells},
    materials = {body = bodies.material}, fill = function() return "body" end,
  })
end

-- Balls about the origin, with `cells` cells across: of whole cells, and of cells that the surface
-- cuts.
bodies.radius = 0.5 -- [m]
function bodies.ball(cells)
  return s.lattice(s.grid{
    cell = 1 / cells, size = {cells, cells, cells}, origin = {-0.5, -0.5, -0.5},
    materials = {body = bodies.material},
    fill = function(x, y, z) return x * x + y * y + z * z < 0.25 and "body" or nil end,
  })
end
function bodies.cut_ball(cells)
  return s.lattice(s.voxelize(ball_mesh(), {
    cell = 1 / cells, materials = {body = bodies.material}, cut_cells = true,
  }))
end

-- Velocity of the centre of mass in a state [m/s], and its position [m].
local function mean(model, of_node)
  local sum = {0, 0, 0}
  for i, node in ipairs(model:nodes()) do
    for d = 1, 3 do sum[d] = sum[d] + node.mass * of_node[i][d] end
  end
  for d = 1, 3 do sum[d] = sum[d] / model.mass end
  return sum
end
function bodies.velocity(model, state) return mean(model, state.v) end
function bodies.position(model, state) return mean(model, state.x) end

-- Time from the first to the last contact of a run [s], nil without any. A frame counts as touching
-- from a fraction of energy in the contacts on, over the whole energy.
function bodies.contact_time(run, fraction)
  local first, last
  for _, entry in ipairs(run.ledger) do
    if entry.contact > fraction * entry.total then
      first, last = first or entry.time, entry.time
    end
  end
  return first and last - first
end

return bodies
