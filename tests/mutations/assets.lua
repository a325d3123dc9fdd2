-- Load and run many damaged assets, and count what becomes of them:
--   springlod run tests/mutations/assets.lua -- COUNT FILE...
-- COUNT may also be FIRST-LAST. Damages assets of format version 6 in turn, each in another way:
-- their bytes, their JSON or their arrays. Every second one gets a valid checksum again, so that
-- only the checks behind it can find the damage. Each level of what is loaded falls onto a floor
-- for some steps. Prints a row for each half: run, refused, and errors of any other kind and calls
-- that take long, which are bugs. Exit code 1 if there are any; their files are kept as
-- mutant-NUMBER.glb in the current folder.

local s = require "springlod"
local glb_text = require "glb_text"
local mutation_run = require "mutation_run"

local kSteps = 20
local kFreeStep = 1e-3 -- of a level without springs [s]

local function any(list) return list[math.random(#list)] end

-- In the form in which springlod writes them, which the checksum covers.
local json_values = {"0", "-1", "1", "0.5", "1e+308", "-1e+308", "1e-300", "4294967295",
                     "4294967296", "18446744073709551615", "null", "true", '"x"', "[]", "{}"}
local numbers = {0.0, -0.0, -1.0, 1e308, -1e308, 1e-308, 5e-324, 1e12, 1e-12, math.huge,
                 -math.huge, 0 / 0}
local integers = {0, 1, 0x7fffffff, 0x80000000, 0xffffffff}

-- Replaces what stands at a place of a text.
local function replaced(text, first, last, by)
  return text:sub(1, first - 1) .. by .. text:sub(last + 1)
end

-- A random number of the JSON text, between its first and last byte.
local function number_in(json)
  local first, last = json:find("%-?%d[%d.e+-]*", math.random(#json))
  if not first then first, last = json:find("%-?%d[%d.e+-]*") end
  return first, last
end

local json_damages = {
  value = function(json)
    local first, last = number_in(json)
    return replaced(json, first, last, any(json_values))
  end,
  other_number = function(json)
    local from, to = number_in(json)
    local first, last = number_in(json)
    return replaced(json, first, last, json:sub(from, to))
  end,
  lost_field = function(json)
    local first, last = json:find('"%a+":%-?%d[%d.e+-]*,', math.random(#json))
    return first and replaced(json, first, last, "") or json
  end,
}

-- A damage to one element of a random array: `change` makes it from what stands there.
local function element(format, change)
  return function(binary, views)
    local view = any(views)
    local size = format:packsize()
    local count = view[2] // size
    if count == 0 then return binary end
    local at = view[1] + size * math.random(0, count - 1)
    if at + size - 1 > #binary then return binary end
    return replaced(binary, at, at + size - 1, format:pack(change((format:unpack(binary, at)))))
  end
end

local array_damages = {
  number = element("<d", function() return any(numbers) end),
  scaled = element("<d", function(value) return value * 10.0 ^ math.random(-12, 12) end),
  negated = element("<d", function(value) return -value end),
  integer = element("<I4", function() return any(integers) end),
  neighbour = element("<I4", function(value) return value + 1 & 0xffffffff end),
  flag = element("B", function() return math.random(0, 255) end),
  exchanged = function(binary, views)
    local one, other = any(views), any(views)
    return replaced(binary, one[1], one[1] + one[2] - 1,
                    binary:sub(other[1], other[1] + one[2] - 1))
  end,
}

-- One to three damages to the JSON and the arrays.
local function damaged_parts(json, binary)
  local views, names = glb_text.views(json), {}
  for n = 1, math.random(3) do
    if math.random(2) == 1 then
      json, names[n] = mutation_run.damaged(json, json_damages)
    else
      local bound = {}
      for name, change in pairs(array_damages) do
        bound[name] = function(bytes) return change(bytes, views) end
      end
      binary, names[n] = mutation_run.damaged(binary, bound)
    end
  end
  return json, binary, table.concat(names, " + ")
end

local function is_valid(number) return number % 2 == 0 end

local function damage(bytes, number)
  if not is_valid(number) and math.random(2) == 1 then
    return mutation_run.damaged(bytes, mutation_run.damages)
  end
  local json, binary = glb_text.split(bytes)
  assert(glb_text.checksum(json, binary) == glb_text.stated_checksum(json),
         "name assets of format version 6")
  local name
  json, binary, name = damaged_parts(json, binary)
  if is_valid(number) then
    json = glb_text.with_checksum(json, glb_text.checksum(json, binary))
  end
  return glb_text.join(json, binary), name
end

local function fall(model, contact)
  local step = s.stable_step(model)
  s.run(model, {
    duration = kSteps * (step < math.huge and step or kFreeStep),
    obstacles = {{plane = {0, 0, 1, model.bounds.low[3]}}},
  }, {contact = contact, quiet = true})
end

mutation_run.run{
  count = (...),
  files = {select(2, ...)},
  title = "checksum",
  group = function(_, number) return is_valid(number) and "valid" or "as damaged" end,
  damage = damage,
  use = function(path)
    local chain = s.load(path)
    s.json(s.info(chain))
    for level = 0, chain.coarsest do
      for _, contact in ipairs{"nodes", "surface"} do fall(chain[level], contact) end
    end
  end,
  done = "run",
  refusals = {input = true, io = true, unstable = true, tunnelled = true},
}
