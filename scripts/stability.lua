-- Map the stability and error of integrators over time step and stiffness ratio.

local s = require "springlod"
local command = require "lib.command"
local lists = require "lib.lists"
local show = require "lib.show"
local stability_estimate = require "lib.stability_estimate"
local study = require "lib.study"

local parser = command.parser("stability", "Run every level of an asset under every integrator "
  .. "over a grid of time steps and stiffness ratios, and compare each run with a reference run "
  .. "of the same model at a small time step. Writes map.csv, bodies.csv, map.svg, map.png "
  .. "and timings.csv (wall-clock times, the only output that varies between runs). After an "
  .. "interruption (Ctrl-C) the same command resumes; springlod sweep plan stability makes a plan "
  .. "of it for other machines.")
parser:argument("asset", "a .glb asset, written by convert or s.save")
command.add_out(parser, "out/stability")
parser:option("--levels", "levels to run, such as 0,2 (default: all)")
  :convert(command.numbers("--levels", 0, true)):argname("<list>")
parser:option("--ratios", "ratios of Young's moduli, stiff to soft mesh part (default: "
  .. "1,10,100,1000,1e4,1e5)"):convert(command.numbers("--ratios", 0)):argname("<list>")
parser:option("--integrators", "integrators to run, such as xpbd,runge_kutta_4 (default: all "
  .. "that know the forces of the asset; the implicit ones know springs only)")
  :convert(command.words_of("--integrators", s.choices.integrator)):argname("<list>")
parser:option("--iterations", "iterations of xpbd and projective_dynamics, such as 1,10,100")
  :convert(command.numbers("--iterations", 1, true)):argname("<list>")
parser:option("--steps", "time steps of explicit integrators, as multiples of the predicted stable "
  .. "step (default: 0.5,0.9,1.1,2,5,20)"):convert(command.numbers("--steps", 0)):argname("<list>")
parser:option("--implicit-steps", "time steps of backward Euler, as multiples of the period of the "
  .. "slowest mode (default: 0.003,0.01,0.03,0.1)")
  :convert(command.numbers("--implicit-steps", 0)):argname("<list>")
parser:option("--sweep-steps", "time steps of xpbd and projective_dynamics, as multiples of the "
  .. "period of the slowest mode (default: 0.0003,0.001,0.003,0.01,0.03)")
  :convert(command.numbers("--sweep-steps", 0)):argname("<list>")
parser:option("--absolute-steps", "steps of all integrators, such as 0.1ms,1ms; replaces the above")
  :convert(command.quantities("--absolute-steps", "time")):argname("<list>")
parser:option("--periods", "length of each run in periods of the slowest mode (default: 1)")
  :convert(command.number("--periods", 0))
parser:option("--duration", "length of each run, such as 0.1s")
  :convert(command.quantity("--duration", "time"))
parser:option("--anchored", "Lua file that returns the anchors of s.stability, nodes of the base "
  .. "that are held (default: the body is free)"):convert(command.lua_file("--anchored"))
parser:flag("--damping", "keep the damping of the springs (default: undamped)")
parser:flag("--fixed-levels", "apply the ratio to the base only and keep the levels as they are; "
  .. "shows the error of a level at ratios it was not built for")
parser:flag("--quick", "use fewer ratios and steps and a quarter of the duration, for a first "
  .. "look")
local args = parser:parse()

-- A quarter of a period is the way from rest to the largest displacement.
local quick = args.quick and {
  ratios = {1, 100}, steps = {0.9, 1.1, 2}, implicit_steps = {0.01, 0.03, 0.1},
  sweep_steps = {0.001, 0.01}, periods = 0.25,
} or {}

-- What s.stability takes where nothing is given.
local function defaults()
  local values = {iterations = {0}, integrators = s.choices.integrator}
  local stated = {ratios = true, steps = true, implicit_steps = true, sweep_steps = true,
                  periods = true}
  for _, option in ipairs(s.options_of("stability")) do
    if stated[option.name] then values[option.name] = load("return " .. option.default)() end
  end
  return values
end

local unknown_seconds = 20 -- of a level at a ratio, with other steps or other modes

-- Estimated time of a level at a ratio.
local function seconds_of(asset)
  local options = {duration = args.duration}
  for name, value in pairs(defaults()) do options[name] = args[name] or quick[name] or value end
  local estimate
  return function(level, ratio)
    if args.absolute_steps or args.anchored or not asset[level] then return unknown_seconds end
    estimate = estimate or stability_estimate(asset, options)
    return estimate(level, ratio)
  end
end

local function map_part(asset, level, ratio)
  return s.stability(asset, {
    levels = {level}, ratios = {ratio}, integrators = args.integrators,
    iterations = args.iterations, steps = args.steps or quick.steps,
    implicit_steps = args.implicit_steps or quick.implicit_steps,
    sweep_steps = args.sweep_steps or quick.sweep_steps, damping = args.damping or false,
    absolute_steps = args.absolute_steps, periods = args.periods or quick.periods,
    duration = args.duration, remake_levels = not args.fixed_levels,
    anchored = args.anchored,
    seed = s.seed, threads = s.threads,
  })
end

-- A unit is a level at a ratio.
local function describe()
  local asset = s.load(args.asset)
  local levels, ratios = args.levels, args.ratios or quick.ratios or defaults().ratios
  if not levels then
    levels = {}
    for level = 0, asset.coarsest do levels[#levels + 1] = level end
  end
  local seconds, units = seconds_of(asset), {}
  for _, level in ipairs(levels) do
    for _, ratio in ipairs(ratios) do
      units[#units + 1] = {
        name = ("level %d, ratio %g"):format(level, ratio),
        seconds = function() return seconds(level, ratio) end,
        make = function() return map_part(asset, level, ratio):rows() end,
      }
    end
  end
  local columns = lists.names_of(s.options_of("StabilityRow"))
  return {{name = "map", columns = columns, timings = {"wall_seconds"}, units = units}}
end

local function percent(fraction)
  return ("%.3g %%"):format(100 * fraction)
end

-- One row per level and integrator: for each ratio the lowest error of any step, else the verdict.
local function best_rows(rows, ratios)
  local lines, of = {}, {}
  for _, row in ipairs(rows) do
    local key = ("%d %s %d"):format(row.level, row.integrator, row.iterations)
    local line = of[key]
    if not line then
      line = {row = row, best = {}}
      of[key] = line
      lines[#lines + 1] = line
    end
    local best = line.best[row.ratio]
    local better = row.error ~= "" and (not best or best.error == "" or row.error < best.error)
    if not best or better then
      line.best[row.ratio] = row
    end
  end
  local cells = {}
  for i, line in ipairs(lines) do
    local row = {line.row.level, line.row.integrator, line.row.iterations}
    for _, ratio in ipairs(ratios) do
      local best = line.best[ratio]
      row[#row + 1] = best.error ~= "" and percent(best.error) or best.verdict
    end
    cells[i] = row
  end
  return cells
end

-- For each level and ratio the cheapest run of the verdict "stable". Excludes
-- backward_euler_direct: spring updates do not count its factorizations.
local function cheapest_rows(rows, bodies)
  local cells = {}
  for i, body in ipairs(bodies) do
    local best
    for _, row in ipairs(rows) do
      local fits = row.level == body.level and row.ratio == body.ratio and row.verdict == "stable"
        and row.integrator ~= "backward_euler_direct"
      if fits and (not best or row.cost < best.cost) then best = row end
    end
    cells[i] = {
      body.level, ("%g"):format(body.ratio), show.measured(body.limit, "time"), body.limited_by,
      percent(body.frequency_error), best and best.integrator or "none",
      best and show.measured(best.step, "time") or "", best and percent(best.error) or "",
      best and ("%.3g"):format(best.cost) or "",
    }
  end
  return cells
end

-- The map of all results.
local function map_of(results)
  local rows = lists.with_fields(results:all("map"), results:columns("map"))
  if #rows == 0 then
    local _, reason = next(results.gaps.map)
    error(reason, 0)
  end
  return s.join_stability(rows)
end

local function write(map, folder, note)
  for _, name in ipairs{"table", "bodies", "timings"} do
    local rows, columns = map[name](map)
    local file = name == "table" and "map" or name
    s.csv(("%s/%s.csv"):format(folder, file), rows, {columns = columns})
  end
  command.chart(folder .. "/map", map,
    {title = "Stability of " .. command.base_name(args.asset) .. note})
end

local function print_tables(map)
  local rows = map:table()
  local bodies = map:bodies()
  local ratios, columns = {}, {"level", "integrator", "iterations"}
  for _, body in ipairs(bodies) do
    if body.level == bodies[1].level then
      ratios[#ratios + 1] = body.ratio
      columns[#columns + 1] = ("%g"):format(body.ratio)
    end
  end
  print("stiff part: " .. map.stiff_part)
  print("\nlowest error of any time step, by ratio of Young's moduli:")
  print(s.format_table(best_rows(rows, ratios), {columns = columns}))
  print("\ncheapest run with the verdict \"stable\" (error and change of energy by the integrator "
    .. "within 10 %), in spring updates per simulated second (backward_euler_direct "
    .. "is excluded, as spring updates do not count factorizations; timings.csv has all times):")
  print(s.format_table(cheapest_rows(rows, bodies), {columns = {
    "level", "ratio", "limit", "limited by", "frequency error", "integrator", "step", "error",
    "cost"}}))
  print([[
ratio: of Young's moduli, stiff to soft. limit: predicted stable step of symplectic
Euler, for the nodes that are not held, and what limits it. frequency error: mean of the six
lowest, against the base. error: of the run with that step.]])
  local counts = {}
  for verdict, count in pairs(map.verdicts) do counts[#counts + 1] = count .. " " .. verdict end
  table.sort(counts)
  print(("\n%d points: %s"):format(#rows, table.concat(counts, ", ")))
  local first = rows[1]
  if (map.verdicts.mechanism or 0) == #rows then
    error(("nothing could be run: level %d has a mechanism at node %d. s.zero_modes lists the "
      .. "nodes of mechanisms; guards, the corners lattice or smaller cells prevent them"):format(
      first.level, first.node), 0)
  end
end

local function report(results, folder)
  local map = map_of(results)
  write(map, folder, results:note())
  print_tables(map)
end

return study.run(args, {
  describe = describe, report = report, failure = "cannot map " .. args.asset,
  hint = (args.quick and "" or "--quick, ") .. "--levels, --ratios and --periods shorten it",
})
