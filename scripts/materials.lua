-- List the presets of materials, with the sources of their constants.

local s = require "springlod"
local command = require "lib.command"

local parser = command.parser("materials", "List materials with published elastic constants. A "
  .. "materials file takes them as presets: return {rod = {preset = \"steel\"}, pad = "
  .. "{preset = \"cork\", density = 200}}.")
parser:flag("--json", "print JSON")
local args = parser:parse()

if args.json then
  print(s.json(s.material_presets, {indent = 2}))
  return
end

-- A modulus in the unit that makes it a number of 1 to 999.
local function pressure(pascals)
  local units = {{1e9, "GPa"}, {1e6, "MPa"}, {1e3, "kPa"}}
  for _, unit in ipairs(units) do
    if pascals >= unit[1] then return ("%.3g %s"):format(pascals / unit[1], unit[2]) end
  end
  return ("%.3g Pa"):format(pascals)
end

local rows = {}
for i, preset in ipairs(s.material_presets) do
  rows[i] = {preset.name, pressure(preset.young), preset.poisson, preset.density, preset.source}
end
print(s.format_table(rows, {columns = {"preset", "E", "nu", "kg/m3", "source of E"}}))
print("\nIn a materials file: return {PART = {preset = \"cork\"}}; springlod convert --materials "
  .. "FILE.lua reads it.")
