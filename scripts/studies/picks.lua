-- Check the levels that pick takes against the best ones by runs of all levels.

local s = require "springlod"
local bodies = require "studies.picks.bodies"
local command = require "lib.command"
local progress = require "lib.progress"
local scenes = require "studies.picks.scenes"
local unit_store = require "lib.unit_store"

local most_error = 1.5 -- of a picked level, over the tolerance

local parser = command.parser("picks", "Pick levels by certificate in six scenes with three "
  .. "tolerances, and compare them with the coarsest levels within the tolerance by runs. Writes "
  .. "levels.csv (predicted and measured error of every level) and picks.csv.")
command.add_out(parser, "out/picks", "folder", true)
parser:option("--set", "bodies and scenes: those that the constants of the prediction were chosen "
  .. "on, or others"):choices{"tuning", "checking"}:default("checking")
parser:option("--bodies", "names of bodies, such as fork,sphere (default: all of the set)")
parser:option("--keep", "nodes of the levels as fractions of those of the base")
  :default("0.6,0.36,0.2"):convert(command.fractions("--keep"))
parser:option("--tolerances", "percent of the diagonal"):default("2,5,10")
  :convert(command.numbers("--tolerances", 0))
parser:flag("--plain", "merged levels; by default, they are calibrated")
parser:option("--contact", "contact points of the levels")
  :choices(s.choices.contact):default("nodes")
parser:flag("--quick", "one body, two scenes; takes seconds")
local args = parser:parse()

local function chosen_bodies()
  local wanted = args.quick and (args.set == "tuning" and "cube" or "bracket") or args.bodies
  local chosen = {}
  for _, body in ipairs(bodies) do
    local named = not wanted or ("," .. wanted .. ","):find("," .. body.name .. ",", 1, true)
    if body.set == args.set and named then chosen[#chosen + 1] = body end
  end
  if #chosen == 0 then error("--bodies: no body of the set " .. args.set .. " is named", 0) end
  return chosen
end

local function make_chain(body)
  local base, plain = body.make(), args.plain or args.quick
  local chain = s.simplify(base,
    {keep = args.keep, grouping = "compact", calibrate = plain and "none" or "modes"})
  return plain and s.certify(chain) or chain, base
end

local level_rows, pick_rows = {}, {}
local counts = {picks = 0, same = 0, coarse = 0, fine = 0}

-- The coarsest level within the tolerance, by predicted or measured errors [%].
local function coarsest_within(levels, tolerance, key)
  local found = 0
  for _, level in ipairs(levels) do
    if level[key] <= tolerance then found = level.level end
  end
  return found
end

local function judge(body, name, levels, tolerance)
  local picked = coarsest_within(levels, tolerance, "predicted")
  local best = coarsest_within(levels, tolerance, "measured")
  local error = levels[picked + 1].measured
  local verdict = "right"
  if error > most_error * tolerance then
    verdict, counts.coarse = "too coarse", counts.coarse + 1
  elseif picked < best - 1 then
    verdict, counts.fine = "too fine", counts.fine + 1
  elseif picked ~= best then
    verdict = "close"
  else
    counts.same = counts.same + 1
  end
  counts.picks = counts.picks + 1
  pick_rows[#pick_rows + 1] = {body.name, name, tolerance, picked, best,
    levels[picked + 1].predicted, error, verdict}
end

-- Predicted and measured error of each level in a scene.
local function measured_levels(chain, scene)
  local function errors(measured)
    return (s.pick(chain, scene, {error = 0.5, measure = measured, contact = args.contact}):table())
  end
  local predicted, measured, levels = errors(false), errors(true), {}
  for i, row in ipairs(predicted) do
    levels[i] = {level = row.level, nodes = row.nodes, predicted = row.error_percent,
                 measured = measured[i].error_percent, predicted_cost = row.cost,
                 measured_cost = measured[i].cost}
  end
  return levels
end

-- The levels in each scene of the list.
local function measure(body, list)
  local chain, base = make_chain(body)
  local frequency, found = s.modes(base, {count = 1})[1].frequency, {}
  for i, scene in ipairs(list) do
    found[i] = measured_levels(chain, s.scenario(scene[2](base.bounds.diagonal, frequency)))
  end
  return found
end

local function note(body, name, levels)
  for _, level in ipairs(levels) do
    level_rows[#level_rows + 1] = {body.name, name, level.level, level.nodes, level.predicted,
      level.measured, level.predicted_cost, level.measured_cost}
  end
  for _, tolerance in ipairs(args.tolerances) do judge(body, name, levels, tolerance) end
end

local level_columns = {"body", "scene", "level", "nodes", "predicted", "measured",
                       "predicted_cost", "measured_cost"}
local pick_columns = {"body", "scene", "tolerance", "picked", "best", "predicted", "measured",
                      "verdict"}

local function study()
  local chosen, list = chosen_bodies(), scenes[args.set]
  if args.quick then list = {list[1], list[4]} end
  local done = progress(#chosen)
  local store = unit_store.open(args.folder, {
    keep = args.keep, plain = args.plain or false, contact = args.contact,
    quick = args.quick or false,
  })
  for _, body in ipairs(chosen) do
    local found = store:value(body.name, function() return measure(body, list) end)
    for i, scene in ipairs(list) do note(body, scene[1], found[i]) end
    done(body.name)
  end
  s.csv(args.folder .. "/levels.csv", level_rows, {columns = level_columns})
  s.csv(args.folder .. "/picks.csv", pick_rows, {columns = pick_columns})
  store:remove()
end

local ok, reason = command.try_in(args.folder, study, true)
if not ok then command.fail("cannot check picks: %s", reason) end
local lines = {}
for i, row in ipairs(pick_rows) do
  lines[i] = {row[1], row[2], ("%g %%"):format(row[3]), row[4], row[5], ("%.2f %%"):format(row[6]),
              ("%.2f %%"):format(row[7]), row[8]}
end
print(s.format_table(lines, {columns = {"body", "scene", "tolerance", "picked level",
  "best by runs", "predicted error", "measured error", "verdict"}}))
print([[
tolerance and errors: of the surface, in percent of the diagonal. best by runs: the coarsest level
whose measured error is within the tolerance.]])
print(("\n%d picks: %d are the best level by runs; %d too coarse (error above %g times the "
  .. "tolerance),\n%d too fine (by more than one level)"):format(counts.picks, counts.same,
  counts.coarse, most_error, counts.fine))
s.say("wrote " .. args.folder)
