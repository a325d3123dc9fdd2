-- What the stock commands share: a parser that exits 2 on wrong use, errors in one plain line,
-- files that return a table, and charts.

local argparse = require "argparse"
local s = require "springlod"

local command = {}

local epilog = "Besides: --seed N, --threads N, -q/--quiet and -v/--verbose as for every command."

-- A parser for `springlod NAME`.
function command.parser(name, summary)
  local parser = argparse("springlod " .. name, summary, epilog)
    :usage_max_width(88):help_max_width(88)
  function parser:error(message)
    io.stderr:write(self:get_usage(), "\n\nspringlod: ", message, "\n")
    os.exit(2, true)
  end
  return parser
end

-- Converters for argparse, which checks what they return; `option` is what messages call it.

-- A quantity such as "2mm" as a number in SI units.
function command.quantity(option, dimension)
  return function(text)
    local ok, value = pcall(s.quantity, text, dimension)
    if ok then return value end
    return nil, option .. ": " .. value.message:gsub("^quantity: ", "")
  end
end

-- A whole number of `least` or more.
function command.whole(option, least)
  return function(text)
    local value = math.tointeger(tonumber(text))
    if value and value >= least then return value end
    return nil, ("%s: '%s' must be a whole number of %d or more"):format(option, text, least)
  end
end

-- A number above `limit`; or equal to it if `inclusive`.
function command.number(option, limit, inclusive)
  return function(text)
    local value = tonumber(text)
    if value and value < math.huge and (value > limit or inclusive and value == limit) then
      return value
    end
    return nil, ("%s: '%s' must be a number %s %g"):format(option, text,
      inclusive and "from" or "above", limit)
  end
end

-- Lists with commas between, such as 1,10,1e3: the words of `text`, each through `convert`.
local function list(text, convert)
  local values = {}
  for word in (text .. ","):gmatch("%s*(.-)%s*,") do
    local value, reason = convert(word)
    if value == nil then return nil, reason end
    values[#values + 1] = value
  end
  return values
end

-- Numbers above `limit`; if `whole`, whole ones from it on.
function command.numbers(option, limit, whole)
  local convert = whole and command.whole(option, limit) or command.number(option, limit)
  return function(text) return list(text, convert) end
end

-- Quantities such as 1ms,5ms in SI units.
function command.quantities(option, dimension)
  return function(text) return list(text, command.quantity(option, dimension)) end
end

function command.words(text)
  return list(text, function(word) return word end)
end

-- Words of `known`.
function command.words_of(option, known)
  local is_known = {}
  for _, word in ipairs(known) do is_known[word] = true end
  return function(text)
    return list(text, function(word)
      if is_known[word] then return word end
      return nil, ("%s: '%s' must be one of %s"):format(option, word, table.concat(known, ", "))
    end)
  end
end

-- Why a call failed: the message of springlod without the line of the script that called it. What
-- is no error of springlod is a fault of a script and keeps its line.
function command.reason(failure)
  if type(failure) == "userdata" and failure.kind then
    if failure.kind == "interrupted" then error(failure, 0) end
    return failure.message
  end
  return tostring(failure)
end

-- Runs work(...); true and its results, or false and the reason. -v shows where it failed.
function command.try(work, ...)
  local function keep_trace(failure)
    if s.verbosity > 0 then s.say(debug.traceback(tostring(failure), 2)) end
    return failure
  end
  local results = table.pack(xpcall(work, keep_trace, ...))
  if results[1] then return table.unpack(results, 1, results.n) end
  return false, command.reason(results[2])
end

-- Ends the command: one line, exit 1.
function command.fail(...)
  io.stderr:write("springlod: ", string.format(...), "\n")
  os.exit(1, true)
end

-- The table that the Lua file at `path` returns.
function command.load_table(path)
  local chunk, message = loadfile(path)
  if not chunk then error(message, 0) end
  local value = chunk()
  if type(value) ~= "table" then
    error(("%s must return a table, got a %s"):format(path, type(value)), 0)
  end
  return value
end

-- s.chart as stem.svg and stem.png.
function command.chart(stem, data, options)
  for _, ending in ipairs{"svg", "png"} do s.chart(stem .. "." .. ending, data, options) end
end

-- The file name of a path, with and without its ending.
function command.base_name(path) return path:match("([^/]+)/*$") or path end
function command.stem(path) return (command.base_name(path):gsub("%.[^.]*$", "")) end

return command
