-- What the mutation runs of this folder share: damages to bytes, and the loop that counts what
-- becomes of damaged files.

local s = require "springlod"

local mutation_run = {}

local kSlow = 20 -- s

function mutation_run.read(path)
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

-- Damages to the bytes of any file, by name.
mutation_run.damages = {
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

-- One of the damages of a table, by chance: the damaged bytes and its name.
function mutation_run.damaged(bytes, damages)
  local names = {}
  for name in pairs(damages) do names[#names + 1] = name end
  table.sort(names)
  local name = names[math.random(#names)]
  return #bytes > 0 and damages[name](bytes) or bytes, name
end

-- `done`, "refused", "crashed" or "other", and the message. "memory" is the kind of an error, too.
local function outcome(options, path)
  local ok, result = pcall(options.use, path)
  if ok then return options.done end
  local message = tostring(result)
  local refusals = options.refusals or {input = true, io = true}
  if type(result) ~= "userdata" or not refusals[result.kind] then return "other", message end
  return options.crash and message:find(options.crash) and "crashed" or "refused", message
end

-- "100" is all numbers up to 100, "17-17" number 17 alone.
local function numbers(text)
  local first, last = text:match("^(%d+)%-(%d+)$")
  first, last = math.tointeger(tonumber(first or 1)), math.tointeger(tonumber(last or text))
  return first or 1, last or error("give the number of damaged files, or FIRST-LAST")
end

-- Damages the files in turn, each number in a way that depends on the seed and the number alone.
-- Prints a row for each group of files, and ends the program with exit code 1 if there was an error
-- of another kind or a call that took long. The fields of options:
--   count    text: COUNT, or FIRST-LAST
--   files    list of paths
--   damage   function(bytes, number) -> damaged bytes, name of the damage
--   use      function(path) that throws for a file that is refused
--   done     what became of a file if `use` returns
--   group    function(path, number) -> name of the row
--   title    of the column of groups
--   crash    (optional) pattern of the message if a library crashed in its child process
--   refusals (optional) kinds of errors that are refusals
function mutation_run.run(options)
  assert(#options.files > 0, "name files to damage")
  local first, last = numbers(options.count or "")
  local kinds = {options.done, "refused", "other", "slow"}
  if options.crash then table.insert(kinds, 3, "crashed") end
  local totals, groups, bugs = {}, {}, 0
  local scratch = os.tmpname()
  os.remove(scratch)
  for i = first, last do
    local file = options.files[(i - 1) % #options.files + 1]
    math.randomseed(s.seed, i)
    local bytes, damage = options.damage(mutation_run.read(file), i)
    -- If the program itself crashes, its file stays.
    local ending = file:match("%.%w+$")
    local path = ("%s-%d%s"):format(scratch, i, ending)
    write(path, bytes)
    local start = os.time()
    local kind, message = outcome(options, path)
    local seconds = os.time() - start
    if seconds > kSlow then kind, message = "slow", ("%d s"):format(seconds) end
    local group = options.group(file, i)
    if not totals[group] then
      totals[group], groups[#groups + 1] = {}, group
    end
    totals[group][kind] = (totals[group][kind] or 0) + 1
    if kind ~= options.done and kind ~= "refused" then
      print(("%s, %s: %s: %s (again: --seed %d, %d-%d)"):format(file, damage, kind, message,
                                                                 s.seed, i, i))
    end
    if kind == "other" or kind == "slow" then
      bugs = bugs + 1
      write(("mutant-%d%s"):format(i, ending), bytes)
    end
    os.remove(path)
  end
  table.sort(groups)
  local rows = {}
  for _, group in ipairs(groups) do
    local row = {group}
    for _, kind in ipairs(kinds) do row[#row + 1] = totals[group][kind] or 0 end
    rows[#rows + 1] = row
  end
  print(s.format_table(rows, {columns = {options.title, table.unpack(kinds)}}))
  if bugs > 0 then os.exit(1) end
end

return mutation_run
