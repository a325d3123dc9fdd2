-- Keeps the results of long runs as CSV files in a folder. Stored results are not computed again,
-- so that an interrupted script resumes where it stopped.

local s = require "springlod"
local command = require "lib.command"

local run_store = {}

local Store = {}
Store.__index = Store

-- Reads rows written by s.csv whose cells hold no commas or quotes; numeric cells become numbers.
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

-- A value, or a table sorted by key, as the text of one cell that read_rows can read.
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
run_store.as_text = as_text

local function check_settings(path, settings)
  local kept = {}
  for _, row in ipairs(read_rows(path)) do kept[row.name] = tostring(row.value) end
  for name, value in pairs(settings) do
    if kept[name] ~= as_text(value) then
      error(("%s holds runs with %s = %s, not %s; use another folder, or remove this one")
        :format(path:match("(.*)/"), name, kept[name] or "nothing", as_text(value)), 0)
    end
  end
end

-- Opens the store in `folder`. `settings` maps names to values or tables and must hold everything
-- that a result depends on. A folder with other settings is an error.
function run_store.open(folder, settings)
  local path = folder .. "/settings.csv"
  if command.exists(path) then
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
function Store:has(name) return command.exists(self:path(name)) end

-- The rows kept under `name`; if there are none, make() computes them.
function Store:rows(name, columns, make)
  if not self:has(name) then s.csv(self:path(name), make(), {columns = columns}) end
  return read_rows(self:path(name))
end

return run_store
