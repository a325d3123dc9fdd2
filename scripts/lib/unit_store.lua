-- Keeps the results of the finished units of a long command, so that an interrupted command
-- continues after them. They are removed when the command has finished: it then starts anew.

local s = require "springlod"
local command = require "lib.command"

local unit_store = {}

local Store = {}
Store.__index = Store

-- A value as Lua text that gives the same value, to the last bit. Tables must form a tree.
local function as_lua(value)
  if type(value) ~= "table" then return ("%q"):format(value) end
  local entries = {}
  for key, entry in pairs(value) do
    entries[#entries + 1] = ("[%s] = %s"):format(as_lua(key), as_lua(entry))
  end
  table.sort(entries)
  return "{" .. table.concat(entries, ", ") .. "}"
end

-- The store of a command that writes to `folder`. `settings` maps names to values or tables and
-- must hold everything, besides the names of the units, that a result depends on.
function unit_store.open(folder, settings)
  return setmetatable({
    folder = folder .. "/unfinished",
    settings = s.version .. " " .. s.seed .. " " .. as_lua(settings),
  }, Store)
end

-- The value kept for the unit `name`; if there is none, make() computes it.
function Store:value(name, make)
  local path = ("%s/%s.lua"):format(self.folder, s.hash{text = self.settings .. " " .. name})
  if not command.exists(path) then s.save_text(path, "return " .. as_lua(make()) .. "\n") end
  return assert(loadfile(path, "t", {}))()
end

-- Removes all units.
function Store:remove()
  command.clear_folder(self.folder, {".lua"}, function(name) return name:find("^%x+%.lua$") end)
end

return unit_store
