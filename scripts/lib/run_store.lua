-- Results that took long to run, kept as CSV files in a folder: what is there is not run again, so
-- that an interrupted script goes on where it was.

local s = require "springlod"

local run_store = {}

local Store = {}
Store.__index = Store

local function exists(path)
  local file = io.open(path, "r")
  if file then file:close() end
  return file ~= nil
end

-- Rows of plain cells (no commas or quotes in them) as written by s.csv: numbers become numbers.
local function read_rows(path)
  local rows, columns = {}, nil
  for line in io.lines(path) do
    local cells = {}
    for cell in (line:gsub("\r$", "") .. ","):gmatch("([^,]*),") do cells[#cells + 1] = cell end
    if columns then
      local row = {}
      for i, column in ipairs(columns) do
        row[column] = math.tointeger(cells[i]) or tonumber(cells[i]) or cells[i]
      end
      rows[#rows + 1] = row
    else
      columns = cells
    end
  end
  return rows
end

-- A value, or a table of values in the order of their keys, as one cell that read_rows takes.
local function as_text(value)
  if type(value) ~= "table" then
    return (tostring(value):gsub("[%c,\"%%]", function(c) return ("%%%02x"):format(c:byte()) end))
  end
  local entries = {}
  for key, entry in pairs(value) do
    entries[#entries + 1] = ("%s = %s"):format(as_text(key), as_text(entry))
  end
  table.sort(entries)
  return "{" .. table.concat(entries, "; ") .. "}"
end

local function check_settings(path, settings)
  local kept = {}
  for _, row in ipairs(read_rows(path)) do kept[row.name] = tostring(row.value) end
  for name, value in pairs(settings) do
    if kept[name] ~= as_text(value) then
      error(("%s holds runs with %s = %s, not %s; take another folder, or remove that one")
        :format(path:match("(.*)/"), name, kept[name] or "nothing", as_text(value)), 0)
    end
  end
end

-- The store in `folder`. `settings` are values or tables of them by name, all on which a result
-- depends; a folder with others is refused.
function run_store.open(folder, settings)
  local path = folder .. "/settings.csv"
  if exists(path) then
    check_settings(path, settings)
  else
    local rows = {}
    for name, value in pairs(settings) do
      rows[#rows + 1] = {name = name, value = as_text(value)}
    end
    table.sort(rows, function(a, b) return a.name < b.name end)
    s.csv(path, rows, {columns = {"name", "value"}})
  end
  return setmetatable({folder = folder}, Store)
end

function Store:path(name) return ("%s/%s.csv"):format(self.folder, name) end
function Store:has(name) return exists(self:path(name)) end

-- The rows kept as `name`; without them make() makes them.
function Store:rows(name, columns, make)
  if not self:has(name) then s.csv(self:path(name), make(), {columns = columns}) end
  return read_rows(self:path(name))
end

return run_store
