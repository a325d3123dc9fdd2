-- Call the API with wrong arguments many times, and count what becomes of the calls:
--   springlod run tests/mutations/calls.lua -- COUNT [FIRST]
-- Takes the functions, their arguments and options from the API's own description, makes valid
-- arguments of each, and puts something wrong into them. Prints a row for each function: returned,
-- refused, raised (the error of a function or table that was made to raise), and what are bugs:
-- other errors and calls that take long. Exit code 1 if there are any. A call depends on the seed
-- and its number alone: COUNT 1 and FIRST repeat it, and -v names each call before it is made.
-- Writes files; use an empty folder.

local s = require "springlod"

local count = math.tointeger(tonumber((...))) or error("give the number of calls")
local first = math.tointeger(tonumber((select(2, ...)) or 1))
local kSlow = 20 -- s of processor time

local function one_of(list) return list[math.random(#list)] end
local function chance(probability) return math.random() < probability end

-- The functions, the methods of values and the records of the API, from the page that documents it:
-- list of {name, owner, arguments, options}, and the fields of each record by name.
local function described()
  local functions, records = {}, {}
  local section, name, owner, rows
  for line in s.api_markdown():gsub("\\|", "!"):gmatch("[^\n]+") do
    local marks, title = line:match("^(##+) (.*)")
    local option, type = line:match("^| `([%w_]+)` | (.-) | ")
    if marks == "##" then
      section, rows = title, nil
    elseif marks == "###" and section == "Tables with known keys" then
      rows = {}
      records[title] = rows
    elseif marks == "###" and section == "Values" then
      owner, rows = title, nil
    elseif marks then
      name = {name = title, owner = section == "Values" and owner or nil, arguments = {},
              options = {}}
      functions[#functions + 1], rows = name, nil
    elseif line == "Arguments:" then
      rows = name.arguments
    elseif line == "Options:" then
      rows = name.options
    elseif option and rows then
      rows[#rows + 1] = {name = option, type = type:gsub("; default.*", ""),
                         required = not type:find("; default")}
    end
  end
  return functions, records
end

local functions, records = described()

local samples = {{1, 2, 3, 4, 5, 6}, {2, 3, 4, 5, 6, 7}, {1, 3, 5, 7, 9, 2}, {1, 1, 2, 3, 5, 8},
                 {2, 4, 6, 8, 1, 3}, {3, 1, 4, 1, 5, 9}, {2, 7, 1, 8, 2, 8}}

-- A small value of each type.
local values = {}
s.save_text("box.obj", [[
v 0 0 0
v 1 0 0
v 1 1 0
v 0 1 0
v 0 0 1
v 1 0 1
v 1 1 1
v 0 1 1
f 4 3 2 1
f 5 6 7 8
f 1 2 6 5
f 2 3 7 6
f 3 4 8 7
f 4 1 5 8
]])
values.Mesh = s.import("box.obj", {unit = "m", up = "z"})
values.Grid = s.voxelize(values.Mesh, {cell = 0.5})
values.Model = s.lattice(values.Grid)
values.LodChain = s.simplify(values.Model, {levels = 1})
values.Scenario = s.scenario{duration = 0.02, obstacles = {{plane = {0, 0, 1, 0}, name = "floor"}}}
values.Trajectory = s.run(values.Model, values.Scenario)
values.State = values.Trajectory.final
values.Comparison = s.compare(values.LodChain, values.Scenario)
values.StabilityMap = s.stability(values.LodChain, {levels = {0}, ratios = {1}, steps = {0.5},
                                                    integrators = {"symplectic_euler"}})
values.Pick = s.pick(values.LodChain, values.Scenario, {error = 0.5})
values.NoiseFloor = s.noise_floor(samples)
values.Error = select(2, pcall(s.import, "missing.obj"))
s.save("chain.glb", values.LodChain)
s.save_vdb("grid.vdb", values.Grid)

local units = [[{count = 3, columns = {"n"}, unit = function(point) return {n = point.index} end}]]
s.save_text("units.lua", "return require('springlod').sweep" .. units)
values.Sweep = s.sweep(load("return " .. units)())

-- Options that keep a valid call short.
local short = {
  stability = {levels = {0}, ratios = {1}, steps = {0.5}, integrators = {"symplectic_euler"}},
  certify = {modes = 3, held_out_loads = 2},
  merge_log = {modes = 3, local_loads = 2},
  random = {nodes = 20},
  refill = {nodes = 8},
  hash = {text = "word"},
  statistics = {resamples = 100}, compare_samples = {resamples = 100},
  noise_floor = {resamples = 100},
  pick = {error = 0.5},
  grid = {cell = 0.5, size = {2, 2, 2}, materials = {soft = {}},
          fill = function() return "soft" end},
  model = {nodes = {{0, 0, 0, mass = 1}, {1, 0, 0, mass = 1}}, springs = {{1, 2, k = 100}}},
  scenario = {duration = 0.01},
  ensemble = {starts = 2}, compare = {starts = 1},
  render = {width = 64, height = 48}, animate = {width = 64, height = 48, frames = 2},
  chart = {width = 300, height = 300},
  deflect = {force = {[27] = {0, 0, 1}}, anchored = {1, 2, 3, 4}},
  sweep = load("return " .. units)(), plan_sweep = {script = "units.lua"},
  submit_sweep = {dry_run = true},
}

local texts = {
  ["import.path"] = "box.obj", ["load.path"] = "chain.glb", ["load_vdb.path"] = "grid.vdb",
  ["save.path"] = "out.glb", ["save_vdb.path"] = "out.vdb", ["render.path"] = "out.png",
  ["chart.path"] = "out.svg", ["video.path"] = "out.gif", ["animate.folder"] = "frames",
  ["video.folder"] = "frames", ["files.folder"] = ".", ["options_of.name"] = "simplify",
  ["quantity.text"] = "5", ["save_text.path"] = "out.txt",
  ["csv.path"] = "out.csv", ["hash.file"] = "box.obj", ["export.path"] = "model",
  ["export_motion.path"] = "motion", ["base64.path"] = "box.obj",
}

local points = {}
for i, node in ipairs(values.LodChain[1]:nodes()) do points[i] = {node.x, node.y, node.z} end

local arrays = {sample = samples[1], base = samples[2], other = samples[3], sources = samples,
                node_values = {}, values = points}

local valid -- (parameter, owner): a valid value

local function record_of(name, wrong)
  local record, fields = {}, records[name]
  for _, field in ipairs(fields) do
    if field.required or chance(0.3) then record[field.name] = valid(field, name) end
  end
  if wrong then record[one_of(fields).name] = wrong() end
  return record
end

function valid(parameter, owner)
  local type, name = parameter.type, parameter.name
  local words = {}
  for word in type:gmatch('"([^"]+)"') do words[#words + 1] = word end
  if values[type] and name ~= "start" then return values[type] end
  if arrays[name] then return arrays[name] end
  if type == "function, value or string" then return "simplify" end
  if type:find("^list of ") and records[type:match("^list of (%w+)")] then
    return {record_of(type:match("^list of (%w+)"))}
  end
  if records[type] then return record_of(type) end
  if type:find("^table part = Material") then return {box = record_of("Material")} end
  if type == "table of strings" then return {levels = "--levels"} end
  if type == "boolean" then return chance(0.5) end
  if type:find("^function") and #words == 0 then
    return function() return math.random() end
  end
  if type:find("^one of") then return one_of(words) end
  if type:find('^list of "') then return {one_of(words)} end
  if name == "folder" and owner == "remove_sweep" then
    s.plan_sweep(values.Sweep, "removed", short.plan_sweep)
    return "removed"
  end
  if name == "folder" and owner:find("sweep") or owner == "forget_failures" then return "units" end
  if type:find("^string") then return texts[owner .. "." .. name] or "word" end
  if type:find("^list of strings") then return {"word"} end
  if type:find("^list of tables") then return {{a = 1, b = "x"}, {a = 2, b = "y"}} end
  if type:find("^list of integers") or type:find("^list of numbers") then return {1} end
  if type:find("^{") then return {1, 2, 3, type:find("offset") and 0 or nil} end
  if type:find("^Comparison, Trajectory") then
    return one_of{values.Comparison, values.Trajectory}
  end
  if type:find("^Comparison") then return values.Comparison end
  if type:find("^LodChain") then return values.LodChain end
  if type:find("^Mesh") then return one_of{values.Mesh, values.Model, values.Trajectory} end
  if name == "level" then return 1 end
  if type:find("^integer") then return math.random(3) end
  return math.random() / 10
end

local raised = setmetatable({}, {__tostring = function() return "raised on purpose" end})
local function raise() error(raised, 0) end
local closed = io.tmpfile and io.tmpfile()
if closed then closed:close() end

local function deep()
  local outer = {}
  local inner = outer
  for _ = 1, 20000 do
    inner[1] = {}
    inner = inner[1]
  end
  return outer
end

local function cyclic()
  local t = {1, 2, 3}
  t[2], t.self, t[t] = t, t, t
  return t
end

-- A few tables that are 2^50 if each is counted where it stands.
local function bushy()
  local t = {}
  for _ = 1, 50 do t = chance(0.5) and {t, t} or {a = t, b = t} end
  return t
end

local function many(entry)
  local list = {}
  for i = 1, 200000 do list[i] = entry end
  return list
end

local numbers = {0, -1, 1, 0.5, -0.5, 2e7, 1e9, -1e9, 2^31, 2^32, 2^53, 1e18, 1e300, -1e300, 1e-300,
                 5e-324, 0 / 0, 1 / 0, -1 / 0, math.maxinteger, math.mininteger, 1e15, 1e16}
local strings = {"", " ", "5", "5 mm", "-5 mm", "1e400 m", "nan", "inf", "\0", "a\0b", "\27[31mred",
                 "\xff\xfe", "%s%n%d{}", "{}{:s}", "auto", "none", "missing/folder/file.obj",
                 ("x"):rep(100000), ("a "):rep(50000), ("\u{e9}"):rep(50000), ("("):rep(5000),
                 ("9"):rep(5000), "1" .. ("0"):rep(400), "\n\n\n", "-", "..", "5 parsecs"}

local makers = {
  function() return one_of(numbers) end,
  function() return one_of(numbers) end,
  function() return one_of(strings) end,
  function() return ("k"):rep(1000000) end,
  function() return chance(0.5) end,
  function() return nil end,
  function() return {} end,
  cyclic, deep, bushy,
  function() return many(1) end,
  function() return many("x") end,
  function() return {one_of(numbers), one_of(numbers), one_of(numbers)} end,
  function() return {one_of(numbers)} end,
  function() return {one_of(strings)} end,
  function() return {{one_of(numbers), one_of(numbers)}, {one_of(numbers)}} end,
  function() return {[one_of{2, 1e9, -1, 0.5, true, "x"}] = one_of(numbers)} end,
  function() return {[one_of(strings)] = one_of(numbers)} end,
  function() return {[("k"):rep(1000000)] = 1} end,
  function() return {[raise] = 1} end,
  function()
    return setmetatable({}, {__index = raise, __newindex = raise, __len = raise, __pairs = raise,
                             __tostring = raise, __call = raise, __eq = raise, __name = 5})
  end,
  function()
    return setmetatable({1, 2, 3}, {__index = function(t) return t end, __len = function()
      return one_of{-1, 1e9, 0.5, "x"} end, __tostring = function() return 5 end})
  end,
  function() return raise end,
  function() return function() end end,
  function() return function() return 0 / 0 end end,
  function() return function(...) return ... end end,
  function() return function() return ("x"):rep(100000) end end,
  function() return coroutine.yield end,
  function() return coroutine.create(raise) end,
  function() return closed end,
  function() return io.stdout end,
  function() return s end,
  function() return s.run end,
  function()
    local names = {}
    for name in pairs(values) do names[#names + 1] = name end
    table.sort(names)
    return values[one_of(names)]
  end,
  function()
    local names = {}
    for name in pairs(records) do names[#names + 1] = name end
    table.sort(names)
    return record_of(one_of(names))
  end,
}
local function wrong() return one_of(makers)() end

-- A wrong value for the parameter; for records often a record with one wrong field.
local function wrong_for(parameter)
  local record = parameter.type:match("(%w+)$")
  if records[record] and chance(0.8) then
    local made = record_of(record, wrong)
    return parameter.type:find("^list of") and {made} or made
  end
  if parameter.type:find("^table part = Material") and chance(0.8) then
    return {box = record_of("Material", wrong)}
  end
  return wrong()
end

local function copy(t)
  local made = {}
  for key, value in pairs(t or {}) do made[key] = value end
  return made
end

-- The arguments of a call with nothing wrong, and its table of options: table.pack(...).
local function valid_call(entry)
  local call = {n = #entry.arguments}
  for i, parameter in ipairs(entry.arguments) do call[i] = valid(parameter, entry.name) end
  if #entry.options == 0 then return call end
  call.n = call.n + 1
  call[call.n] = copy(short[entry.name])
  return call, call[call.n]
end

-- The arguments of a call that has something wrong.
local function arguments_of(entry)
  local call, options = valid_call(entry)
  local has_options = options ~= nil
  local kind = math.random(has_options and 8 or 3)
  if kind == 1 and call.n > 0 then
    local i = math.random(call.n)
    local parameter = entry.arguments[i]
    call[i] = parameter and wrong_for(parameter) or wrong()
  elseif kind == 2 and call.n > 1 then
    local i, j = math.random(call.n), math.random(call.n)
    call[i], call[j] = call[j], call[i]
  elseif kind == 3 then
    for i = 1, call.n do
      if chance(0.5) then call[i] = wrong() end
    end
    call.n = math.max(0, call.n + math.random(-2, 1))
  elseif kind == 4 then
    local name = entry.options[math.random(#entry.options)].name
    options[one_of{name .. "s", name:sub(2), name:upper(), one_of(strings)}] = wrong()
  elseif kind >= 5 and has_options then
    for _ = 1, one_of{1, 1, 1, 2, 4} do
      local option = one_of(entry.options)
      options[option.name] = kind < 8 and wrong_for(option) or valid(option, entry.name)
    end
  end
  return call
end

local function shown(call)
  local words = {}
  for i = 1, call.n do
    local ok, text = pcall(s.inspect, call[i])
    text = ok and text or type(call[i])
    words[i] = #text > 300 and text:sub(1, 300) .. "..." or text
  end
  return table.concat(words, ", ")
end

-- "returned", "refused", "raised" or "other", and the message.
local function outcome(call_it, call)
  local ok, failure = pcall(call_it, table.unpack(call, 1, call.n))
  if ok then return "returned" end
  if failure == raised or tostring(failure):find("^attempt to yield") then return "raised" end
  local kind = type(failure) == "userdata" and failure.kind
  local refused = kind == "input" or kind == "io" or kind == "unstable" or kind == "tunnelled"
  return refused and "refused" or "other", tostring(failure)
end

local function name_of(entry) return (entry.owner and entry.owner .. ":" or "") .. entry.name end
local function function_of(entry) return (entry.owner and values[entry.owner] or s)[entry.name] end
local function with_self(entry, call, self)
  if not entry.owner then return call end
  call.n = call.n + 1
  table.insert(call, 1, self)
  return call
end

-- Wrong arguments in place of valid ones say nothing where the valid ones are refused too.
for _, entry in ipairs(functions) do
  local call = with_self(entry, valid_call(entry), values[entry.owner])
  local kind, message = outcome(function_of(entry), call)
  if kind ~= "returned" then
    error(("valid call of %s(%s): %s"):format(name_of(entry), shown(call), message))
  end
end

local kinds = {"returned", "refused", "raised", "other", "slow"}
local counts, names = {}, {}
for number = first, first + count - 1 do
  math.randomseed(s.seed, number)
  local entry = one_of(functions)
  local name = name_of(entry)
  if not counts[name] then counts[name], names[#names + 1] = {}, name end
  local self = chance(0.1) and wrong() or values[entry.owner]
  local call = with_self(entry, arguments_of(entry), self)
  if s.verbosity > 0 then s.say(("call %d: %s(%s)"):format(number, name, shown(call))) end
  local start = os.clock()
  local kind, message = outcome(function_of(entry), call)
  local seconds = os.clock() - start
  if kind ~= "other" and seconds > kSlow then kind = "slow" end
  counts[name][kind] = (counts[name][kind] or 0) + 1
  if kind == "other" or kind == "slow" then
    print(("call %d, %.0f s, %s: %s(%s): %s"):format(number, seconds, kind, name, shown(call),
                                                    message or "returned"))
  end
end

table.sort(names)
local rows, total, bugs = {}, {"all"}, 0
for _, name in ipairs(names) do
  local row = {name}
  for i, kind in ipairs(kinds) do
    row[i + 1] = counts[name][kind] or 0
    total[i + 1] = (total[i + 1] or 0) + row[i + 1]
  end
  bugs = bugs + row[5] + row[6]
  rows[#rows + 1] = row
end
rows[#rows + 1] = total
print(s.format_table(rows, {columns = {"function", table.unpack(kinds)}}))
if bugs > 0 then os.exit(1) end
