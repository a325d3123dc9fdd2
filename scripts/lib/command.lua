-- Shared by the stock commands: the argument parser (exit code 2 on wrong use), one-line error
-- messages, Lua files that return a table, and charts.

local argparse = require "argparse"
local s = require "springlod"

local command = {}

local epilog = "Also: --seed N, --threads N, -q/--quiet and -v/--verbose, as for every command."

local name_of_command -- NAME, as folders remember it

-- One line: options that must be given, and the arguments.
local function usage_of(parser, name)
  local words = {"Usage: springlod", name, "[options]"}
  for _, option in ipairs(parser._options) do
    if option._mincount > 0 then words[#words + 1] = option:_get_usage() end
  end
  for _, argument in ipairs(parser._arguments) do words[#words + 1] = argument:_get_usage() end
  return table.concat(words, " ")
end

-- Lets messages and the help name the options of the API by the flags of this command. `words`:
-- flags of options that the command has under other names.
local function speak_in_flags(parser, words)
  local flags = {}
  for _, option in ipairs(parser._options) do
    local flag = option._aliases[#option._aliases]
    local name = option._target or flag:gsub("^%-+", ""):gsub("%-", "_")
    flags[flag:find("^%-%-no%-") and name:gsub("^no_", "") or name] = flag
  end
  flags.help = nil
  for name, flag in pairs(words) do flags[name] = flag end
  s.use_flags(flags)
  for _, option in ipairs(parser._options) do
    if option._description then option._description = s.in_flags(option._description) end
  end
end

-- Where the output goes may be given in two ways.
local function settle_out(parser, args)
  if args.out and args.folder then
    parser:error(("give the folder once: '%s' or --out '%s'"):format(args.folder, args.out))
  end
  args.out = args.out or args.folder or parser.out_default
  args.folder = args.out
end

-- The words of the command line; argparse takes a negative number for an option, unless it is
-- joined to its own: --azimuth=-30.
local function with_joined_negatives(words)
  local joined = {}
  for _, word in ipairs(words) do
    local before = joined[#joined]
    if before and before:find("^%-%-%a[%w-]*$") and word:find("^%-%.?%d") then
      joined[#joined] = before .. "=" .. word
    else
      joined[#joined + 1] = word
    end
  end
  return joined
end

local caught -- receives the parser of a command in place of running it

-- A parser for `springlod NAME`. A positional argument may be left out if it has a default; with
-- args("?") as well, argparse would ignore the default. `words`: flags of options of the API that
-- the command has under other names, such as {style = "--lattice"}.
function command.parser(name, summary, words)
  name_of_command = name
  local parser = argparse("springlod " .. name, summary, epilog):help_max_width(88)
  function parser:error(message)
    io.stderr:write("springlod: ", (message:gsub("\n", "; ")), "\n", self:get_usage(),
      "  (springlod ", name, " --help explains it)\n")
    os.exit(2, true)
  end
  local parse = parser.parse
  function parser:parse()
    self:usage(usage_of(self, name))
    speak_in_flags(self, words or {})
    if caught then caught(self) end
    local args = parse(self, with_joined_negatives(arg))
    if self.out_default then settle_out(self, args) end
    return args
  end
  return parser
end

-- The option -o/--out, which every command has that writes files. `what`: "folder", or a kind of
-- file. If `positional`, a folder may also be given as an argument, args.folder.
function command.add_out(parser, default, what, positional)
  what = what or "folder"
  parser.out_default = default
  if positional then parser:argument("folder", "the same as --out"):args("?") end
  return command.one_line(parser:option("-o --out", ("%s to write to (default: %s)"):format(what,
    default)):argname("<" .. what .. ">"))
end

-- Both names of an option in one line of the help, where argparse takes two.
function command.one_line(option)
  function option:_get_label_lines()
    return {table.concat(self._public_aliases, ", ") .. " " .. self:_get_argument_list()[1]}
  end
  return option
end

-- An option that has another name now: an error that states it.
function command.renamed(parser, old, new)
  parser:option(old):hidden(true):action(function()
    parser:error(("%s is now %s"):format(old, new))
  end)
end

-- The stock commands: list of {name, summary, path, study}, studies last.
function command.list()
  local all, scripts = {}, s.samples:gsub("samples$", "scripts")
  for _, folder in ipairs{scripts, scripts .. "/studies"} do
    for _, path in ipairs(s.files(folder, {endings = {".lua"}})) do
      local file <close> = assert(io.open(path))
      all[#all + 1] = {name = command.stem(path), summary = file:read("l"):gsub("^[- ]+", ""),
                       path = path, study = folder ~= scripts}
    end
  end
  return all
end

-- The path of the script of a stock command.
function command.path_of(name)
  for _, one in ipairs(command.list()) do
    if one.name == name then return one.path end
  end
end

-- The name of this command, and the path of its script.
function command.name() return name_of_command end
function command.script() return command.path_of(name_of_command) end

-- The parser of a stock command, which does not run: for help, manual pages and completion.
function command.parser_of(path)
  local found
  caught = function(parser)
    found = parser
    error("caught", 0)
  end
  local _, failure = pcall(assert(loadfile(path)))
  caught = nil
  return found or error(failure, 0)
end

-- Converters for argparse: each returns the value, or nil and an error message. `option` is the
-- name that the message uses.

-- A quantity such as "2mm" as a number in SI units.
function command.quantity(option, dimension)
  return function(text)
    local ok, value = pcall(s.quantity, text, dimension)
    if ok then return value end
    return nil, option .. ": " .. value.message:gsub("^quantity: ", "")
  end
end

-- Upper limits of options without one of their own: more runs or pictures than anyone waits for,
-- and the limit of numbers in the API.
local kMostWhole, kMostNumber = 1000000, 1e15

-- An integer of `least` to `most`.
function command.whole(option, least, most)
  most = most or kMostWhole
  return function(text)
    local value = math.tointeger(tonumber(text))
    if value and value >= least and value <= most then return value end
    return nil, ("%s: '%s' must be an integer of %d to %d"):format(option, text, least, most)
  end
end

-- A number above `limit`, or equal to it if `inclusive`, up to `most`.
function command.number(option, limit, inclusive, most)
  most = most or kMostNumber
  return function(text)
    local value = tonumber(text)
    if value and value <= most and (value > limit or inclusive and value == limit) then
      return value
    end
    return nil, ("%s: '%s' must be a number %s %g, up to %g"):format(option, text,
      inclusive and "of at least" or "above", limit, most)
  end
end

-- A comma-separated list, such as 1,10,1e3; `convert` parses each word.
local function list(text, convert)
  local values = {}
  for word in (text .. ","):gmatch("%s*(.-)%s*,") do
    local value, reason = convert(word)
    if value == nil then return nil, reason end
    values[#values + 1] = value
  end
  return values
end

-- Numbers above `limit`; if `whole`, integers of at least `limit`.
function command.numbers(option, limit, whole)
  local convert = whole and command.whole(option, limit) or command.number(option, limit)
  return function(text) return list(text, convert) end
end

-- Fractions above 0, up to 1, such as 0.45,0.2 or 45%,20%.
function command.fractions(option)
  local read = command.quantity(option, "number")
  return function(text)
    return list(text, function(word)
      local value, reason = read(word)
      if value and value > 0 and value <= 1 then return value end
      local percent = value and value > 1 and value <= 100 and ("; write %g%% for %g per cent")
        :format(value, value) or ""
      return nil, reason or ("%s: '%s' must be above 0 and at most 1%s"):format(option, word,
        percent)
    end)
  end
end

-- Quantities such as 1ms,5ms in SI units.
function command.quantities(option, dimension)
  return function(text) return list(text, command.quantity(option, dimension)) end
end

-- Words that must be in `known`.
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

-- The message of a failed call. Errors of springlod come without the line of the calling script;
-- other errors are bugs of a script and keep their line.
function command.reason(failure)
  if type(failure) == "userdata" and failure.kind then
    if failure.kind == "interrupted" then error(failure, 0) end
    return failure.message
  end
  return tostring(failure)
end

-- Runs work(...). Returns true and its results, or false and the message. -v prints a traceback.
function command.try(work, ...)
  local function keep_trace(failure)
    if s.verbosity > 0 then s.say(debug.traceback(tostring(failure), 2)) end
    return failure
  end
  local results = table.pack(xpcall(work, keep_trace, ...))
  if results[1] then return table.unpack(results, 1, results.n) end
  return false, command.reason(results[2])
end

-- Runs work() as command.try does, while no other run uses `folder`. A folder of another command is
-- an error. `resumes`: whether work continues a run that did not finish.
function command.try_in(folder, work, resumes)
  return command.try(s.in_folder, folder, work, {command = name_of_command, resumes = resumes})
end

-- Prints one line and ends the command with exit code 1.
function command.fail(...)
  io.stderr:write("springlod: ", string.format(...), "\n")
  os.exit(1, true)
end

-- Runs the Lua file at `path`, which must return a table.
function command.load_table(path)
  local chunk, message = loadfile(path)
  if not chunk then error(message, 0) end
  local value = chunk()
  if type(value) ~= "table" then
    error(("%s must return a table, got %s"):format(path,
      value == nil and "nothing" or "a " .. type(value)), 0)
  end
  return value
end

local function file_converter(option, load)
  return function(path)
    local ok, value = command.try(load, path)
    if ok then return value end
    return nil, option .. ": " .. value
  end
end

-- A converter: the path of a Lua file as the table that it returns.
function command.table_file(option) return file_converter(option, command.load_table) end

-- A converter: the path of a Lua file as the value that it returns.
function command.lua_file(option)
  return file_converter(option, function(path)
    local chunk, message = loadfile(path)
    local value = chunk and chunk()
    if value == nil then error(message or path .. " returns nothing", 0) end
    return value
  end)
end

-- Words as one line for a shell.
function command.shell_line(words)
  local quoted = {}
  for i, word in ipairs(words) do
    quoted[i] = word:find("^[%w%%+,./:=@_-]+$") and word or "'" .. word:gsub("'", "'\\''") .. "'"
  end
  return table.concat(quoted, " ")
end

-- The words of a command line without the options named, each with its value, and without the
-- words that dropped(word) accepts. A short name, "-o", may have its value joined to it.
function command.without(words, names, dropped)
  local kept, skipped = {}, false
  for _, word in ipairs(words) do
    local is_named, is_joined = false, false
    for _, name in ipairs(names) do
      local joint = name:find("^%-%-") and name .. "=" or name
      is_named = is_named or word == name
      is_joined = is_joined or word ~= name and word:sub(1, #joint) == joint
    end
    if not (skipped or is_named or is_joined or dropped(word)) then kept[#kept + 1] = word end
    skipped = is_named
  end
  return kept
end

-- The words of the command line without the folder to write to; `args`: what they were read as.
function command.words_without_out(args)
  return command.without(arg, {"-o", "--out"}, function(word) return word == args.folder end)
end

-- The command line of this run, to copy; with `args`, without the folder to write to.
function command.line(args)
  return command.shell_line{"springlod", "--seed", tostring(s.seed), name_of_command,
                            table.unpack(args and command.words_without_out(args) or arg)}
end

-- Writes s.chart to stem.svg and stem.png.
function command.chart(stem, data, options)
  for _, ending in ipairs{"svg", "png"} do s.chart(stem .. "." .. ending, data, options) end
end

function command.exists(path)
  local file = io.open(path, "r")
  if file then file:close() end
  return file ~= nil
end

-- Removes the files of a folder that have one of the endings and whose name is_own(name) accepts,
-- and the folder if it holds nothing else.
function command.clear_folder(folder, endings, is_own)
  if not s.is_folder(folder) then return end
  for _, path in ipairs(s.files(folder, {endings = endings})) do
    if is_own(command.base_name(path)) then os.remove(path) end
  end
  os.remove(folder)
end

-- The file name of a path, with and without its extension.
function command.base_name(path) return path:match("([^/]+)/*$") or path end
function command.stem(path) return (command.base_name(path):gsub("%.[^.]*$", "")) end

return command
