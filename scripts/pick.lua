-- Pick the coarsest level that is accurate enough for a scene, or the best for a cost.

local s = require "springlod"
local command = require "lib.command"

local parser = command.parser("pick", "Pick a level of an asset for one scene: the coarsest level "
  .. "that stays within an error, or the most accurate level within a cost per frame. The error is "
  .. "the surface error of `springlod compare`. Without --measure it is predicted from the "
  .. "certificates and a few runs of the coarsest level. Exit code 1 if no level fits.")
parser:argument("asset", "a .glb asset, written by convert or s.save")
parser:option("--scenario", "Lua file that returns a table for s.scenario")
  :argname("<file.lua>"):count(1)
parser:mutex(
  parser:option("--error", "largest error, such as 2%, of the bounding diagonal of the base")
    :convert(command.quantity("--error", "number")):argname("<percent>"),
  parser:option("--budget", "largest processor time for a frame, such as 2ms")
    :convert(command.quantity("--budget", "time")):argname("<time>"))
parser:flag("--measure", "run the base and all levels: measures errors and costs")
parser:option("--frame-rate", "frames per second")
  :convert(command.number("--frame-rate", 0)):default("60")
parser:option("--contact", "contact points of the levels (default: as in the asset)")
  :choices(s.choices.contact)
parser:option("--error-window", "time after the first contact up to which errors are averaged "
  .. "(default: 0.25s)"):convert(command.quantity("--error-window", "time"))
parser:flag("--json", "print JSON")
local args = parser:parse()
if not (args.error or args.budget) then
  parser:error("give --error (such as --error 2%) or --budget (such as --budget 2ms)")
end
if args.error and not (args.error > 0 and args.error < 1) then
  parser:error(("--error: %g must be above 0%% and below 100%%; write %g%% for %g per cent"):format(
    args.error, args.error, args.error))
end
if args.budget and args.budget <= 0 then parser:error("--budget: the time must be above 0") end

local function pick()
  return s.pick(s.load(args.asset), s.scenario(command.load_table(args.scenario)), {
    error = args.error, budget = args.budget, measure = args.measure or false,
    frame_rate = args.frame_rate, contact = args.contact, error_window = args.error_window,
    threads = s.threads,
  })
end

local ok, picked = command.try(pick)
if not ok then command.fail("cannot pick a level of %s: %s", args.asset, picked) end
local rows = picked:table()

local function print_json()
  local levels = {}
  for i, row in ipairs(rows) do
    levels[i] = {
      level = row.level, nodes = row.nodes, springs = row.springs, cost = row.cost,
      cost_ratio = row.cost_ratio, error = row.error ~= "" and row.error or nil,
      within = row.within == 1,
    }
  end
  print(s.json{
    level = picked.level, measured = picked.measured, error = args.error, budget = args.budget,
    frame_rate = args.frame_rate, text = picked.text, levels = levels,
  })
end

local function print_table()
  local lines = {}
  for i, row in ipairs(rows) do
    lines[i] = {row.level, row.nodes, row.springs, ("%.3g"):format(1000 * row.cost),
                ("%.1f"):format(row.cost_ratio),
                row.error ~= "" and ("%.2f"):format(row.error_percent) or "-",
                (row.within == 1 and "yes" or "no") .. (row.level == picked.level and " *" or "")}
  end
  print(s.format_table(lines, {columns = {
    "level", "nodes", "springs", "ms a frame", "base / level",
    (picked.measured and "measured" or "predicted") .. " error [%]", "within"}}))
  print(([[
ms a frame: processor time for 1/%g s. base / level: ratio of these times. error: that of the
surface, until %g s after the first contact, in percent of the bounding diagonal of the base.]])
    :format(args.frame_rate, args.error_window or 0.25))
  if picked.level then print("*: picked.") end
  print()
  print(picked.text)
end

if args.json then print_json() else print_table() end
if not picked.level then os.exit(1, true) end
