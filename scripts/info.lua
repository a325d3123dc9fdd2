-- Print the contents of an asset, level by level.

local s = require "springlod"
local certificates = require "lib.certificates"
local command = require "lib.command"

local parser = command.parser("info", "Print the contents of an asset, level by level.")
parser:argument("asset", "a .glb asset, written by convert or s.save")
parser:flag("--json", "print JSON")
local args = parser:parse()

local ok, chain = command.try(s.load, args.asset)
if not ok then command.fail("cannot read %s: %s", args.asset, chain) end
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
certificates.print(info.levels)
local base = info.levels[1]
print()
print(("center of mass  %.4g %.4g %.4g m"):format(table.unpack(base.center_of_mass)))
for i, name in ipairs{"inertia", "", ""} do
  print(("%-14s  %.4g %.4g %.4g kg m2"):format(name, table.unpack(base.inertia[i])))
end
for _, material in ipairs(base.materials) do
  print(("material        %s: young %.4g Pa, density %.4g kg/m3, damping %.4g s"):format(
    material.name, material.young, material.density, material.damping))
end
local keys = {}
for key in pairs(info.provenance) do keys[#keys + 1] = key end
table.sort(keys)
for _, key in ipairs(keys) do
  local entry = info.provenance[key]
  if key == "command" then entry = entry .. " " .. command.shell_line{"-o", args.asset} end
  print(("%-14s  %s"):format(key, entry))
end
