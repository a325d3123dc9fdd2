-- Print the contents of an asset or a mesh.

local s = require "springlod"
local certificates = require "lib.certificates"
local command = require "lib.command"
local mesh_info = require "lib.mesh_info"

local parser = command.parser("info", "Print the contents of an asset, level by level; or of a "
  .. "mesh: its parts, size and faults, and what convert would do with it.")
parser:argument("file", "a .glb asset, written by convert or s.save, or a mesh file")
parser:option("--unit", "length unit of a mesh file (default: as the file declares, else m)")
  :choices(s.choices.unit)
parser:flag("--json", "print JSON")
local args = parser:parse()

local function print_mesh(mesh)
  local info = mesh_info.of(mesh)
  print(args.json and s.json(info) or mesh_info.text(info))
end

-- A .glb file may be an asset or a mesh; files with the other endings of meshes are meshes.
local ending = (args.file:match("%.%w+$") or ""):lower()
local may_be_mesh = false
for _, known in ipairs(s.mesh_endings) do may_be_mesh = may_be_mesh or ending == known end
local ok, chain
if ending == ".glb" or not may_be_mesh then ok, chain = command.try(s.load, args.file) end
if not ok and may_be_mesh then
  local imported, mesh = command.try(s.import, args.file, {unit = args.unit})
  if imported then return print_mesh(mesh) end
  chain = chain or mesh
end
if not ok then command.fail("cannot read %s: %s", args.file, chain) end
local info = s.info(chain)
if args.json then
  print(s.json(info))
  return
end

print(chain)
local rows = {}
for i, level in ipairs(info.levels) do
  rows[i] = {level.level, level.nodes, level.springs, level.ends, level.corners, level.border_nodes,
             ("%.4g"):format(level.mass), ("%.4g"):format(level.stable_dt),
             ("%.4g"):format(level.undamped_dt), level.limited_by, level.made_by}
end
print()
print(s.format_table(rows, {columns = {"level", "nodes", "springs", "ends", "corners", "border",
                                       "mass [kg]", "stable step [s]", "without damping [s]",
                                       "limited by", "made by"}}))
print(("\ncontact points of the levels: %s (%s)"):format(info.contact,
  s.choices.contact[info.contact].help))
local points = chain[0].contact_point_count
if points > 0 then
  print(("those of the base: %d points of the true surface (cut cells)"):format(points))
end
certificates.print(info.levels)
local base = info.levels[1]
print()
print(("center of mass  %.4g %.4g %.4g m"):format(table.unpack(base.center_of_mass)))
for i, name in ipairs{"inertia", "", ""} do
  print(("%-14s  %.4g %.4g %.4g kg m2"):format(name, table.unpack(base.inertia[i])))
end
for _, material in ipairs(base.materials) do
  print(("material        %s: young %.4g Pa, poisson %.3g, density %.4g kg/m3, damping %.4g s")
    :format(material.name, material.young, material.poisson, material.density, material.damping))
end
local keys = {}
for key in pairs(info.provenance) do keys[#keys + 1] = key end
table.sort(keys)
for _, key in ipairs(keys) do
  local entry = info.provenance[key]
  if key == "command" then
    -- convert --bodies separate appends the number of the body to the name.
    local asset = info.provenance.body and args.file:gsub("%-%d+(%.%w+)$", "%1") or args.file
    entry = entry .. " " .. command.shell_line{"-o", asset}
  end
  print(("%-14s  %s"):format(key, entry))
end
