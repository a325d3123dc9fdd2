-- Compare the base and its fitted levels with known answers of mechanics.

local s = require "springlod"
local command = require "lib.command"
local lists = require "lib.lists"
local problems = require "studies.validate.problems"
local report = require "studies.validate.report"
local unit_store = require "lib.unit_store"

local keep = {0.45, 0.2} -- nodes of the fitted levels over those of the base
local quick_iterations = 3 -- of a fit

local parser = command.parser("validate", "Solve problems whose answer is known, with the base at "
  .. "three sizes and with levels of 45 % and 20 % of its nodes, fitted by default. Writes "
  .. "validation.md (text, tables, verdicts), table.csv, and a chart of each problem to images.")
command.add_out(parser, "out/validation")
parser:option("--problems", "any of " .. table.concat(lists.names_of(problems), ", "))
  :default("all"):convert(command.words_of("--problems",
    table.move(lists.names_of(problems), 1, #problems, 2, {"all"})))
parser:flag("--quick", "two small sizes of each problem, hardly fitted; takes seconds")
local args = parser:parse()

local function chosen(problem)
  for _, word in ipairs(args.problems) do
    if word == "all" or word == problem.name then return true end
  end
  return false
end

-- The base and, if there are any, its fitted levels, as a chain.
local function new_chain(problem, size)
  local base = problem.body(size)
  if not problem.fitted then return s.simplify(base, {levels = 0}) end
  return s.simplify(base, {
    keep = keep, grouping = "compact", calibrate = "modes", seed = s.seed,
    calibration = {iterations = args.quick and quick_iterations or nil,
                   modes = problem.fitted_modes,
                   anchored = problem.anchored and problem.anchored(size)},
  })
end

local kept = {} -- chains by body and size, of bodies that several problems have

local function chain_of(problem, size)
  local users = 0
  for _, other in ipairs(problems) do
    if other.body == problem.body and chosen(other) then users = users + 1 end
  end
  if users == 1 then return new_chain(problem, size) end
  local by_size = kept[problem.body] or {}
  kept[problem.body] = by_size
  by_size[size] = by_size[size] or new_chain(problem, size)
  return by_size[size]
end

-- What a problem can ask of a level: see problems.lua.
local function context_of(chain, number)
  local map = chain:group_map(number)
  return {
    base = chain[0],
    carried = function(nodes) return chain:carried(number, nodes) end,
    group_of = function(node) return map[node] end,
    to_base = function(values) return chain:to_base(number, values) end,
  }
end

-- List of {level, nodes, values}.
local function measured(problem, size)
  local rows, chain = {}, chain_of(problem, size)
  for level = 0, chain.coarsest do
    local model = chain[level]
    rows[level + 1] = {level = level, nodes = model.node_count,
                       values = problem.measure(model, size, context_of(chain, level))}
  end
  return rows
end

local function solve(problem, store)
  local sizes, rows = args.quick and problem.quick or problem.sizes, {}
  for _, size in ipairs(sizes) do
    local found = store:value(problem.name .. " " .. size, function()
      return measured(problem, size)
    end)
    for _, row in ipairs(found) do
      row.size = size
      rows[#rows + 1] = row
    end
    s.say(("%s: %d %s"):format(problem.title, size, problem.size_name))
  end
  return rows
end

local ok, failure = command.try_in(args.out, function()
  local store = unit_store.open(args.out, {quick = args.quick or false})
  local pages = {}
  for _, problem in ipairs(problems) do
    if chosen(problem) then
      pages[#pages + 1] = report.page(problem, solve(problem, store), not args.quick)
    end
  end
  report.write(args.out, pages)
  report.print(pages)
  store:remove()
end, true)
if not ok then command.fail("validate: %s", failure) end
s.say("wrote " .. args.out)
