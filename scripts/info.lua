-- Print the contents of an asset or a mesh.

local s = require "springlod"
local asset_or_mesh = require "lib.asset_or_mesh"
local certificates = require "lib.certificates"
local command = require "lib.command"
local mesh_info = require "lib.mesh_info"
local show = require "lib.show"

local parser = command.parser("info", "Print the contents of an asset, level by level; or of a "
  .. "mesh: its parts, size and faults, and what convert would do with it.")
parser:argument("file", "a .glb asset, written by convert or s.save, or a mesh file")
parser:option("--unit", "length unit of a mesh file (default: as the file declares, else m)")
  :choices(s.choices.unit)
parser:option("--up", "up axis of a mesh file (default: as the file or its format defines)")
  :choices(s.choices.up)
parser:flag("--json", "print JSON")
local args = parser:parse()

local function print_mesh(mesh)
  local info = mesh_info.of(mesh)
  print(args.json and s.json(info) or mesh_info.text(info))
  if args.json or info.doubt or info.refusal then return end
  local words = {args.file}
  for _, option in ipairs{"unit", "up"} do
    if args[option] then table.move({"--" .. option, args[option]}, 1, 2, #words + 1, words) end
  end
  s.say("next: springlod convert " .. command.shell_line(words))
end

local chain, mesh = asset_or_mesh(args.file, args)
if mesh then
  print_mesh(mesh)
  return
end
local info = s.info(chain)
if args.json then
  print(s.json(info))
  return
end

-- "368 -> 161 -> 78"
local function of_levels(key)
  local values = {}
  for i, level in ipairs(info.levels) do values[i] = tostring(level[key]) end
  return table.concat(values, " -> ")
end

print(("asset of %d level%s, base to coarsest: %s nodes, %s springs"):format(
  #info.levels, #info.levels == 1 and "" or "s", of_levels("nodes"), of_levels("springs")))
local rows = {}
for i, level in ipairs(info.levels) do
  rows[i] = {level.level, level.nodes, level.springs, level.corners, level.border_nodes,
             show.measured(level.mass, "mass"), show.measured(level.stable_dt, "time"),
             show.measured(level.undamped_dt, "time"), level.limited_by, level.made_by}
end
print()
print(s.format_table(rows, {columns = {"level", "nodes", "springs", "corners", "border", "mass",
                                       "stable step", "without damping", "limited by",
                                       "made by"}}))
print([[
border: nodes at the surface. corners: of cells, which resist turning inside out. stable step: the
longest time step with which a run stays stable, and the same without damping; limited by: what
keeps it from being longer. springlod help glossary explains more words.]])
print(("\ncontact points of the levels: %s (%s)"):format(info.contact,
  s.choices.contact[info.contact].help))
local points = chain[0].contact_point_count
if points > 0 then
  print(("those of the base: %d points of the true surface (cut cells)"):format(points))
end
certificates.print(info.levels)
local base = info.levels[1]
print()
local size, moment = chain[0].volume ^ (1 / 3), 0
for axis = 1, 3 do
  moment = math.max(moment, base.inertia[axis][axis])
end
local function vector(values, scale, unit)
  local texts = {}
  for i, value in ipairs(values) do texts[i] = show.number(value, 4, scale) end
  return table.concat(texts, " ") .. " " .. unit
end
print("center of mass  " .. vector(base.center_of_mass, size, "m"))
for i, name in ipairs{"inertia", "", ""} do
  print(("%-14s  %s"):format(name, vector(base.inertia[i], moment, "kg m2")))
end
for _, material in ipairs(base.materials) do
  print(("material        %s: young %s, poisson %.3g, density %.4g kg/m3, damping time %s"):format(
    material.name, show.quantity(material.young, "pressure"), material.poisson, material.density,
    show.quantity(material.damping, "time")))
end
-- A name for the asset that a slim one was made of.
local function whole_asset(slim)
  local name = slim:gsub("%-slim(%.%w+)$", "%1")
  return name ~= slim and name or slim:gsub("(%.%w+)$", "-whole%1")
end

local keys = {}
for key in pairs(info.provenance) do keys[#keys + 1] = key end
table.sort(keys)
for _, key in ipairs(keys) do
  local entry = info.provenance[key]
  if key == "command" then
    -- convert --bodies separate appends the number of the body to the name.
    local asset = info.provenance.body and args.file:gsub("%-%d+(%.%w+)$", "%1") or args.file
    local whole = info.provenance.slim and whole_asset(args.file) or asset
    entry = entry .. " " .. command.shell_line{"-o", whole}
    if info.provenance.slim then
      entry = ("%s && springlod slim %s"):format(entry, command.shell_line{whole, "-o", args.file})
    end
  end
  local cell = key == "cell" and tonumber(entry:match("^(%S+) m$"))
  print(("%-14s  %s"):format(key, cell and show.quantity(cell, "length", 4) or entry))
end
