-- Write a level of an asset as a file of another program.

local s = require "springlod"
local command = require "lib.command"

local parser = command.parser("export", "Write a level of an asset as a file of another program: "
  .. "an engine, a solver or a viewer. Prints the settings that keep the body stable and right "
  .. "there, and what the format does not hold.")
parser:argument("asset", "a .glb asset, written by convert or s.save")
parser:option("--to", "format: " .. table.concat(s.choices.to, ", ")):count(1)
  :choices(s.choices.to):argname("<format>")
parser:option("--level", "level to write; 0 is the base"):convert(command.whole("--level", 0, 1000))
  :default("0")
parser:option("-o --out", "file to write (default: beside the asset, NAME-levelN with the format's "
  .. "ending)"):argname("<file>")
local args = parser:parse()

local function default_path()
  return ("%s-level%d"):format(args.asset:gsub("%.%w+$", ""), args.level)
end

local function export()
  return s.export(args.out or default_path(), s.load(args.asset),
    {to = args.to, level = args.level})
end

local ok, written = command.try(export)
if not ok then command.fail("cannot export %s: %s", args.asset, written) end
for _, line in ipairs(written.settings) do print(line) end
for _, line in ipairs(written.losses) do print("not in the file: " .. line) end
s.say("wrote " .. table.concat(written.files, ", "))
