-- Functions that make a lattice, for lists of bodies.

local s = require "springlod"

local lattices = {}

-- Of a sample mesh. `options`: unit, cell, core, and materials (name of a file in samples/).
function lattices.sample(name, options)
  return function()
    local mesh = s.import(("%s/%s.obj"):format(s.samples, name), {unit = options.unit, up = "z"})
    return s.lattice(s.voxelize(mesh, {
      cell = options.cell, core = options.core,
      materials = dofile(("%s/%s.lua"):format(s.samples, options.materials)),
      priority = name == "ball" and {"core"} or nil,
    }), {hinges = "fill"})
  end
end

-- Of a grid that `fill` fills, see s.grid.
function lattices.filled(cell, size, materials, fill)
  return function()
    return s.lattice(s.grid{cell = cell, size = size, materials = materials, fill = fill})
  end
end

return lattices
