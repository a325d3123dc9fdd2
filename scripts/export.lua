-- Write a level of an asset, or its motion in a scene, as a file of another program.

local s = require "springlod"
local certificates = require "lib.certificates"
local command = require "lib.command"

local model_formats = table.concat(s.choices.model_format, ", ")
local motion_formats = table.concat(s.choices.motion_format, ", ")

local parser = command.parser("export", "Write a level of an asset as a file of another program: "
  .. "an engine, a solver or a viewer. With --scenario, run the level and write its motion. Prints "
  .. "the settings that keep the body stable and right there, and what the format does not hold.")
parser:argument("asset", "a .glb asset, written by convert or s.save")
local to = parser:option("--to", ("format of a level: %s; of a motion: %s"):format(
  model_formats, motion_formats)):count(1):argname("<format>")
to.completed = {table.unpack(s.choices.model_format)} -- what shells complete
for _, format in ipairs(s.choices.motion_format) do
  if not s.choices.model_format[format] then to.completed[#to.completed + 1] = format end
end
parser:option("--level", "level to write; 0 is the base"):convert(command.whole("--level", 0, 1000))
  :default("0")
parser:option("--scenario", "Lua file that returns a table for s.scenario: writes the motion")
  :argname("<file.lua>")
parser:option("--frame-rate", "frames per second of a motion")
  :convert(command.number("--frame-rate", 0)):default("30")
parser:option("--influences", "largest number of joints that move a vertex of a skinned glb")
  :convert(command.whole("--influences", 1, 8)):default("4")
parser:option("-o --out", "file to write (default: beside the asset, NAME-levelN-FORMAT)")
  :argname("<file>")
local args = parser:parse()

local known = args.scenario and s.choices.motion_format or s.choices.model_format
if not known[args.to] then
  parser:error(("--to: '%s' is no format of a %s; those are %s"):format(args.to,
    args.scenario and "motion" or "level", args.scenario and motion_formats or model_formats
      .. (s.choices.motion_format[args.to] and "; motions need --scenario" or "")))
end

local function default_path()
  local path = ("%s-level%d-%s"):format(args.asset:gsub("%.%w+$", ""), args.level, args.to)
  if args.to ~= "newton" then return path end
  -- Python imports it by its name.
  local name = command.base_name(path)
  return path:sub(1, -#name - 1) .. name:gsub("%W", "_")
end

local function export()
  local chain, path = s.load(args.asset), args.out or default_path()
  if args.level <= chain.coarsest then
    certificates.warn_of_faults(chain, args.asset, {args.level})
  end
  if not args.scenario then return s.export(path, chain, {to = args.to, level = args.level}) end
  if args.level > #chain then
    error(("--level: the asset has no level %d; its coarsest is %d"):format(
      args.level, #chain), 0)
  end
  local run = s.run(chain[args.level], s.scenario(command.load_table(args.scenario)),
    {frame_rate = args.frame_rate, ledger = false})
  return s.export_motion(path, run, {to = args.to, influences = args.influences})
end

local ok, written = command.try(export)
if not ok then command.fail("cannot export %s: %s", args.asset, written) end
for _, line in ipairs(written.settings) do print(line) end
for _, line in ipairs(written.losses) do print("not in the file: " .. line) end
local more = #written.files > 3 and (" and %d more files"):format(#written.files - 1)
s.say("wrote " .. (more and written.files[1] .. more or table.concat(written.files, ", ")))
