-- Import many damaged meshes, and count what becomes of them:
--   springlod run tests/mutations/meshes.lua -- COUNT FILE...
-- Damages the files in turn, each in another way, imports them, and voxelizes what is a mesh.
-- Prints a row for each format: imported, refused by us, refused because assimp crashed or did not
-- end, and errors of any other kind and calls that take long, which are bugs. Exit code 1 if there
-- are any; their files are kept as mutant-NUMBER in the current folder.

local s = require "springlod"

local count = math.tointeger(tonumber((...))) or error("give the number of damaged files")
local files = {select(2, ...)}
assert(#files > 0, "name mesh files to damage")
local kSlow = 20 -- s
math.randomseed(s.seed)

local function read(path)
  local file = assert(io.open(path, "rb"))
  local bytes = file:read("a")
  file:close()
  return bytes
end

local function write(path, bytes)
  local file = assert(io.open(path, "wb"))
  assert(file:write(bytes))
  assert(file:close())
end

-- A random range of at most `most` bytes.
local function range(bytes, most)
  local first = math.random(#bytes)
  return first, math.min(#bytes, first + math.random(most) - 1)
end

local extremes = {"0", "-1", "1e308", "-1e308", "nan", "inf", "4294967295",
                  "18446744073709551615", ""}

local damages = {
  cut = function(bytes) return bytes:sub(1, math.random(0, #bytes - 1)) end,
  bytes = function(bytes)
    for _ = 1, math.random(8) do
      local at = math.random(#bytes)
      bytes = bytes:sub(1, at - 1) .. string.char(math.random(0, 255)) .. bytes:sub(at + 1)
    end
    return bytes
  end,
  ones = function(bytes)
    local first, last = range(bytes, 8)
    return bytes:sub(1, first - 1) .. ("\xff"):rep(last - first + 1) .. bytes:sub(last + 1)
  end,
  lost = function(bytes)
    local first, last = range(bytes, 200)
    return bytes:sub(1, first - 1) .. bytes:sub(last + 1)
  end,
  twice = function(bytes)
    local first, last = range(bytes, 200)
    return bytes:sub(1, last) .. bytes:sub(first)
  end,
  moved = function(bytes)
    local first, last = range(bytes, 200)
    local rest = bytes:sub(1, first - 1) .. bytes:sub(last + 1)
    local at = math.random(0, #rest)
    return rest:sub(1, at) .. bytes:sub(first, last) .. rest:sub(at + 1)
  end,
  number = function(bytes)
    local first, last = bytes:find("%-?%d[%d.eE+-]*", math.random(#bytes))
    if not first then return bytes:sub(2) end
    return bytes:sub(1, first - 1) .. extremes[math.random(#extremes)] .. bytes:sub(last + 1)
  end,
}
local names = {}
for name in pairs(damages) do names[#names + 1] = name end
table.sort(names)

-- "imported", "refused", "crashed" or "other", and the message.
local function outcome(path)
  local ok, result = pcall(function()
    local mesh = s.import(path)
    local size = 0
    for axis = 1, 3 do size = math.max(size, mesh.max[axis] - mesh.min[axis]) end
    s.voxelize(mesh, {cell = size / 20})
  end)
  if ok then return "imported" end
  local message = tostring(result)
  if type(result) ~= "userdata" or (result.kind ~= "input" and result.kind ~= "io") then
    return "other", message
  end
  return message:find("the reader of this format") and "crashed" or "refused", message
end

local kinds = {"imported", "refused", "crashed", "other", "slow"}
local totals, formats = {}, {}
local folder = os.tmpname()
os.remove(folder)
for i = 1, count do
  local file = files[(i - 1) % #files + 1]
  local ending = file:match("%.%w+$"):lower()
  if not totals[ending] then
    totals[ending], formats[#formats + 1] = {}, ending
  end
  local damage = names[math.random(#names)]
  local path = folder .. ending
  local bytes = read(file)
  write(path, #bytes > 0 and damages[damage](bytes) or bytes)
  local start = os.time()
  local kind, message = outcome(path)
  if os.time() - start > kSlow then kind = "slow" end
  totals[ending][kind] = (totals[ending][kind] or 0) + 1
  if kind ~= "imported" and kind ~= "refused" then
    print(("%s, %s, number %d: %s: %s"):format(file, damage, i, kind, message))
    if kind ~= "crashed" then os.rename(path, ("mutant-%d%s"):format(i, ending)) end
  end
  os.remove(path)
end

table.sort(formats)
local rows, bugs = {}, 0
for _, ending in ipairs(formats) do
  local row = {ending}
  for _, kind in ipairs(kinds) do row[#row + 1] = totals[ending][kind] or 0 end
  bugs = bugs + row[5] + row[6]
  rows[#rows + 1] = row
end
print(s.format_table(rows, {columns = {"format", table.unpack(kinds)}}))
if bugs > 0 then os.exit(1) end
