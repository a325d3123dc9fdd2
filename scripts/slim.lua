-- Write an asset with what an engine needs and no more.

local s = require "springlod"
local command = require "lib.command"
local show = require "lib.show"

local parser = command.parser("slim", "Write an asset with what an engine needs and no more: the "
  .. "surface, all levels, the maps between them and their stable steps, in single precision. It "
  .. "takes about a third of the bytes. springlod reads it as any asset, but it has no "
  .. "certificates; keep the asset that it was made of. It also writes slim assets of older "
  .. "versions of the format again.")
parser:argument("asset", "a .glb asset, written by convert or s.save")
parser:option("-o", "asset to write (default: NAME-slim.glb beside the asset)")
  :target("output"):argname("<asset>")
local args = parser:parse()
local output = args.output or args.asset:gsub("%.[^./]*$", "") .. "-slim.glb"
if not output:lower():find("%.glb$") then
  parser:error(("-o '%s' must end in .glb"):format(output))
end

local function size(path)
  local file <close> = assert(io.open(path, "rb"))
  return file:seek("end")
end

local function level_rows(chain)
  local rows = {}
  for i, level in ipairs(chain.levels) do
    rows[i] = {i - 1, level.node_count, level.spring_count, level.corner_count,
               show.measured(s.stable_step(level), "time")}
  end
  return rows
end

local ok, failure = command.try(function()
  local chain = s.load(args.asset)
  if s.same_file(args.asset, output) then
    error("the asset would overwrite itself; give -o another name", 0)
  end
  s.save(output, chain, {slim = true})
  print(s.format_table(level_rows(chain),
    {columns = {"level", "nodes", "springs", "corners", "stable step"}}))
  local before, after = size(args.asset), size(output)
  print(("%.1f kB instead of %.1f kB (%.0f %%): %s"):format(
    after / 1000, before / 1000, 100 * after / before, s.load(output).provenance.slim))
  s.say("wrote " .. output)
end)
if not ok then command.fail("cannot slim %s: %s", args.asset, failure) end
