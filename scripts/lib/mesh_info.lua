-- What a mesh is, and what convert would do with it.

local command = require "lib.command"
local s = require "springlod"
local show = require "lib.show"

local mesh_info = {}

-- Bodies that people simulate are rarely longer or shorter; otherwise the unit is doubtful [m].
local longest, shortest = 5, 0.005
-- Cells that convert puts along the longest side by default, and cells across a part of which it
-- consists well enough.
local default_cells, cells_across = 32, 3

local function length(meters) return show.quantity(meters, "length") end

-- A cell size as a word of the command line: 31.2mm.
local function cell_word(meters) return (length(meters):gsub(" ", "")) end

-- The longest side of the bounding box [m].
local function longest_side(mesh)
  local side = 0
  for axis = 1, 3 do side = math.max(side, mesh.max[axis] - mesh.min[axis]) end
  return side
end

-- A remark about the unit, or nil.
local function doubt(mesh, side)
  if not mesh.unit_assumed or (side <= longest and side >= shortest) then return nil end
  local others = {}
  for _, unit in ipairs{"mm", "cm", "dm", "m"} do
    local size = side / mesh.unit * s.quantity("1 " .. unit, "length")
    if size <= longest and size >= shortest then
      others[#others + 1] = ("--unit %s makes it %s"):format(unit, length(size))
    end
  end
  return ("The file does not state its unit, and %s is an unusual size: %s."):format(length(side),
    #others > 0 and table.concat(others, ", ") or "give --unit")
end

-- The cells that convert would make by default, or why it would refuse the mesh. Warnings are
-- printed as by convert.
local function default_grid(mesh, cell)
  local made, grid = command.try(s.voxelize, mesh, {cell = cell})
  if not made then return {refusal = grid} end
  return {cells = grid.cell_count, bodies = grid.body_count}
end

-- A table of what is known, for JSON too.
function mesh_info.of(mesh)
  local side = longest_side(mesh)
  local solids, volume, thinnest = mesh.solids, 0, math.huge
  for _, solid in ipairs(solids) do
    volume = volume + math.abs(solid.volume)
    if solid.thickness > 0 then thinnest = math.min(thinnest, solid.thickness) end
  end
  local cell = side / default_cells
  local grid = default_grid(mesh, cell)
  return {
    format = mesh.format, unit = mesh.unit, unit_assumed = mesh.unit_assumed,
    size = {mesh.max[1] - mesh.min[1], mesh.max[2] - mesh.min[2], mesh.max[3] - mesh.min[3]},
    vertices = mesh.vertex_count, triangles = mesh.triangle_count, volume = volume,
    parts = mesh.parts, solids = solids, doubt = doubt(mesh, side),
    default_cell = cell, default_cells = grid.cells, bodies = grid.bodies, refusal = grid.refusal,
    fine_cell = thinnest < math.huge and math.min(cell, thinnest / cells_across) or cell,
  }
end

-- What becomes of the mesh by default.
local function default_line(info)
  local split = info.bodies > 1
    and ("; they form %d bodies that do not touch (see convert --bodies)"):format(info.bodies) or ""
  return ("  --cell %s  %d cells, the default%s"):format(cell_word(info.default_cell),
    info.default_cells, split)
end

-- The same as text.
function mesh_info.text(info)
  local lines = {}
  local function say(...) lines[#lines + 1] = string.format(...) end
  say("%s, %d vertices, %d triangles, %s x %s x %s (1 unit = %g m%s)", info.format, info.vertices,
      info.triangles, length(info.size[1]), length(info.size[2]), length(info.size[3]), info.unit,
      info.unit_assumed and ", assumed" or "")
  if info.doubt then say("%s", info.doubt) end
  local parts = {}
  for i, part in ipairs(info.parts) do
    parts[i] = {part.name, part.material, part.triangle_count}
  end
  say("")
  lines[#lines + 1] = s.format_table(parts, {columns = {"part", "material", "triangles"}})
  local solids, faults = {}, {}
  for i, solid in ipairs(info.solids) do
    solids[i] = {solid.part, solid.holes == 0 and "yes" or "no",
                 show.quantity(math.abs(solid.volume), "volume"), length(solid.thickness)}
    for _, fault in ipairs(solid.faults) do faults[#faults + 1] = fault end
  end
  say("")
  lines[#lines + 1] = s.format_table(solids, {columns = {"solid", "closed", "volume", "thickness"}})
  say("thickness: median distance from the surface to the other side; of a tube, its wall")
  say("")
  if #faults > 0 then
    say(info.refusal and "Faults:" or "convert would repair (--repair strict refuses these):")
    for _, fault in ipairs(faults) do say("  %s", fault) end
  else
    say("No faults.")
  end
  if info.refusal then
    say("convert would refuse it: %s", info.refusal)
    return table.concat(lines, "\n")
  end
  say("Cells:")
  say("%s", default_line(info))
  if info.fine_cell < 0.99 * info.default_cell then
    say("  --cell %s  about %.0f cells, %d across the thinnest solid", cell_word(info.fine_cell),
        info.volume / info.fine_cell ^ 3, cells_across)
  end
  return table.concat(lines, "\n")
end

return mesh_info
