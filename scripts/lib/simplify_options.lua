-- The options of s.simplify for commands: each of them, and each key of the tables that it takes,
-- becomes an option of the command line.

local s = require "springlod"
local command = require "lib.command"

local simplify_options = {}

-- Records whose keys are options too, with the heading of these in the help.
local records = {
  {name = "simplify", heading = "Levels"},
  {name = "Calibration", heading = "Calibration"},
  {name = "Guard", heading = "Guards"},
}
local is_record = {Calibration = true, Guard = true}

-- Those that the commands have under another name: --seed and --resume.
local left_out = {seed = true, store = true, keep_every = true}

-- The name of an option on the command line, and its key in the parsed arguments.
local function flag(option)
  local on = option.type == "boolean" and option.default == "true"
  return (on and "--no-" or "--") .. option.name:gsub("_", "-"), (on and "no_" or "") .. option.name
end

local converters = {
  integer = function(name, option)
    return command.whole(name, option.least or 0, option.most or math.maxinteger)
  end,
  number = function(name, option)
    return command.number(name, option.least or 0, true, option.most)
  end,
  quantity = function() return function(text) return text end end, -- read by s.simplify
  ["list of numbers"] = command.fractions,
}

local arguments = {["list of numbers"] = "<fractions>", integer = "<count>"}

local function add_option(parser, option, default)
  local name, target = flag(option)
  if option.type == "boolean" then
    local help = target == option.name and option.help
      or "switch off: " .. option.help:gsub("; false:.*", "")
    return parser:flag(name, help):target(target)
  end
  local help = ("%s (default: %s)"):format(option.help, default or option.default:gsub('"', ""))
  if #option.choices > 0 then
    return parser:option(name, help):target(target):choices(option.choices)
  end
  local converter = converters[option.type]
  if converter then
    return parser:option(name, help):target(target):convert(converter(name, option))
      :argname(arguments[option.type] or "<" .. option.type .. ">")
  end
  local returned = ("%s; a Lua file that returns it (%s)"):format(option.help, option.type)
  return parser:option(name, returned):target(target):argname("<file.lua>")
    :convert(command.lua_file(name))
end

-- Calls visit(option, record) for each option that is not a record itself.
local function each(visit)
  for _, record in ipairs(records) do
    for _, option in ipairs(s.options_of(record.name)) do
      if not left_out[option.name] and not is_record[option.type] then visit(option, record) end
    end
  end
end

-- Adds them to a parser. `defaults`: those of the command where they differ, by name.
function simplify_options.add(parser, defaults)
  local groups = {}
  each(function(option, record)
    local added = groups[record.heading] or {}
    groups[record.heading] = added
    added[#added + 1] = add_option(parser, option, defaults[option.name])
  end)
  for _, record in ipairs(records) do
    parser:group(record.heading, table.unpack(groups[record.heading]))
  end
end

-- The names of those that were given, as on the command line.
function simplify_options.given(args)
  local names = {}
  each(function(option)
    local name, target = flag(option)
    if args[target] ~= nil then names[#names + 1] = name end
  end)
  return names
end

-- The table for s.simplify. `defaults`: values of options that were not given, by name.
function simplify_options.read(args, defaults)
  local values = {simplify = {}, Calibration = {}, Guard = {}}
  each(function(option, record)
    local _, target = flag(option)
    local value = args[target]
    if value ~= nil and target ~= option.name then value = false end
    if value == nil then value = defaults[option.name] end
    values[record.name][option.name] = value
  end)
  local options = values.simplify
  for key, record in pairs{calibration = values.Calibration, guard = values.Guard} do
    if next(record) then options[key] = record end
  end
  return options
end

return simplify_options
