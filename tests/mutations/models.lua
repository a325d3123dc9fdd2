-- Convert meshes to base models, and draw each with its mesh:
--   springlod run tests/mutations/models.lua -- PICTURES FILE...
-- For example the test models of assimp (Debian package assimp-testmodels):
--   find /usr/share/assimp/models -type f \
--     -exec springlod -q run tests/mutations/models.lua -- out/models {} +
-- Files that are not meshes are left out.
-- Prints a row for each mesh, and the share of those that bound anything that were converted. Exit
-- code 1 if it is below 80 %.

local s = require "springlod"

local pictures, files = ..., {select(2, ...)}
assert(#files > 0, "give a folder for pictures, and mesh files")
local goal = 0.8
-- A solid bounds something if its holes are less than this fraction of its whole surface.
local open_fraction = 0.5
-- Smallest volume of a solid as a fraction of the cube over the longest side: a single cell of the
-- default grid.
local smallest_volume = 1 / 32 ^ 3

local function bounds_something(mesh)
  local side = 0
  for axis = 1, 3 do side = math.max(side, mesh.max[axis] - mesh.min[axis]) end
  for _, solid in ipairs(mesh.solids) do
    -- of a rod; a plate has half of it, a ball one and a half times
    local area = solid.thickness > 0 and 4 * solid.volume / solid.thickness or 0
    if solid.volume > smallest_volume * side ^ 3 and
       solid.hole_area < open_fraction * (area + solid.hole_area) then
      return true
    end
  end
  return false
end

local is_mesh = {}
for _, ending in ipairs(s.mesh_endings) do is_mesh[ending] = true end

-- What becomes of a mesh file: a word, a remark, and whether it counts.
local function outcome(path, picture)
  local imported, mesh = pcall(s.import, path)
  if not imported then return "not a mesh", tostring(mesh) end
  local bounded = bounds_something(mesh)
  local ok, model = pcall(function()
    local grid = s.voxelize(mesh)
    local model = s.lattice(grid)
    s.render(picture, {mesh, model}, {springs = true, titles = {path, tostring(grid)}})
    return model
  end)
  if ok then return "converted", tostring(model), bounded end
  return bounded and "refused" or "bounds nothing", tostring(model), bounded
end

table.sort(files)
local rows, counted, converted = {}, 0, 0
for _, path in ipairs(files) do
  if is_mesh[(path:match("%.%w+$") or ""):lower()] then
    local picture = ("%s/%03d.png"):format(pictures, #rows + 1)
    local word, remark, counts = outcome(path, picture)
    if counts then
      counted = counted + 1
      if word == "converted" then converted = converted + 1 end
    end
    rows[#rows + 1] = {#rows + 1, path, word, remark}
    collectgarbage() -- Lua does not know how large models are
  end
end
print(s.format_table(rows, {columns = {"picture", "mesh", "outcome", "model or reason"}}))
print(("%d of %d meshes that bound anything were converted"):format(converted, counted))
if converted < goal * counted then os.exit(1) end
