-- Measure the error of each merge and recommend where to stop merging.

local s = require "springlod"
local command = require "lib.command"
local fit_store = require "lib.fit_store"
local merge_ladder = require "lib.merge_ladder"
local page = require "lib.page"
local percent = require("lib.show").percent
local split_table = require "lib.split_table"

local parser = command.parser("mergelog", "Merge the base of an asset step by step and certify "
  .. "each step against the base. Reports where to stop, which merges contribute most to the "
  .. "error, and the error without them. Writes index.html (a page with all of it), levels.csv, "
  .. "answers.csv, merges.csv, charts (errors, costs) and where.png, a picture of the merges and "
  .. "their errors.")
parser:argument("asset", "a .glb asset, written by convert or s.save")
command.add_out(parser, "out/mergelog")
parser:option("--tolerance", "allowed mean relative error of the ten lowest frequencies "
  .. "(default: 0.05; calibrated levels: 0.005)"):convert(command.number("--tolerance", 0))
parser:option("--steps", "number of levels below the base (default: 10; --quick: 3)")
  :convert(command.whole("--steps", 1))
parser:option("--least", "node count of the coarsest level as a fraction of the base")
  :convert(command.number("--least", 0)):default("0.1")
parser:option("--grouping", "how nodes are grouped for merging")
  :choices(s.choices.grouping):default("standard")
parser:option("--border", "merging rule for border nodes")
  :choices(s.choices.border):default("none")
parser:flag("--as-made", "analyze the levels of the asset, build no new ones")
parser:flag("--calibrate", "calibrate the levels, as convert --calibrate modes does")
parser:option("--leave-out", "fraction of the merges of a step, costliest first, that a second "
  .. "build of the level leaves out; 0: no second build (always so with --as-made or --calibrate)")
  :convert(command.number("--leave-out", 0, true)):default("0.05")
parser:flag("--quick", "use few steps, for a first look")
local args = parser:parse()
if args.least >= 1 then parser:error("--least must be below 1 (1 is the base itself)") end
if args.leave_out >= 1 then parser:error("--leave-out must be below 1 (1 would leave out all)") end

local tolerance = args.tolerance or (args.calibrate and 0.005 or 0.05)

local builds_without = args.leave_out > 0 and not args.calibrate and not args.as_made

local function worst_local(certificate)
  local worst
  for _, load in ipairs(certificate.loads) do
    if load.held_out and (not worst or math.abs(load.error) > math.abs(worst.error)) then
      worst = load
    end
  end
  return worst
end

local function where(merge)
  local at = {}
  for axis, x in ipairs(merge.position) do -- rounding errors such as -7e-17 print as 0
    at[axis] = math.abs(x) < 1e-9 and 0 or x
  end
  return ("%s%s, %d nodes, at %.3g %.3g %.3g m"):format(merge.material,
    merge.border and " surface" or " inside", merge.base_nodes, table.unpack(at))
end

-- One entry per level: its certificate, the errors of its merges, and its certificate without the
-- costliest merges.
local function measure(chain)
  local log, levels = s.merge_log(chain, {from_base = not args.as_made}), {}
  for i, info in ipairs(s.info(chain).levels) do
    local c, step = info.certificate, log[i - 1]
    if c then
      local entry = {
        level = info.level, nodes = info.nodes, kept = info.nodes / chain[0].node_count,
        certificate = c, step = step, merged = merge_ladder.merged(step),
        worst_local = worst_local(c),
      }
      if builds_without then
        local model, without, count =
          merge_ladder.without_costliest(chain, step, args.leave_out)
        if model then
          entry.without = {
            nodes = model.node_count, certificate = without, count = count,
            kept = model.node_count / chain[0].node_count,
          }
        end
      end
      levels[#levels + 1] = entry
      s.say(("%d nodes: %s"):format(entry.nodes, percent(c.f1_10_error)))
    end
  end
  return levels
end

local level_columns = {
  "level", "nodes", "kept", "f1_10_error", "f11_20_error", "smooth_load_error",
  "local_load_error", "worst_local_error", "worst_local", "omega_over_base", "cost_over_base",
  "costliest_material", "costliest_surface", "x", "y", "z",
  "left_out_merges", "left_out_nodes", "left_out_f1_10_error", "left_out_cost_over_base",
}

local function level_row(entry)
  local c, first, without = entry.certificate, entry.merged[1], entry.without
  local row = {
    level = entry.level, nodes = entry.nodes, kept = entry.kept, f1_10_error = c.f1_10_error,
    f11_20_error = c.f11_20_error, smooth_load_error = c.fitted_load_error,
    local_load_error = c.held_out_load_error, worst_local_error = entry.worst_local
      and entry.worst_local.error, worst_local = entry.worst_local and entry.worst_local.name,
    omega_over_base = c.highest_frequency / c.base_highest_frequency,
    cost_over_base = c.cost_ratio, costliest_material = first.material,
    costliest_surface = first.border and 1 or 0, x = first.position[1], y = first.position[2],
    z = first.position[3],
  }
  if without then
    row.left_out_merges, row.left_out_nodes = without.count, without.nodes
    row.left_out_f1_10_error = without.certificate.f1_10_error
    row.left_out_cost_over_base = without.certificate.cost_ratio
  end
  return row
end

-- Signed relative change of each frequency and compliance by each step.
local function answer_rows(levels)
  local rows = {}
  for _, entry in ipairs(levels) do
    for _, answer in ipairs(entry.step.answers) do
      rows[#rows + 1] = {entry.level, entry.step.from, entry.nodes, answer.name, answer.kind,
                         answer.change, answer.error}
    end
  end
  return rows, {"level", "from", "nodes", "answer", "kind", "change", "error"}
end

local function merge_rows(levels)
  local rows = {}
  for _, entry in ipairs(levels) do
    for rank, m in ipairs(entry.merged) do
      rows[#rows + 1] = {
        entry.level, entry.step.from, rank, m.node, m.pieces, m.base_nodes, m.position[1],
        m.position[2], m.position[3], m.material, m.border and 1 or 0, m.frequencies,
        m.smooth_loads, m.local_loads,
      }
    end
  end
  return rows, {"level", "from", "rank", "node", "pieces", "base_nodes", "x", "y", "z", "material",
                "surface", "frequencies", "smooth_loads", "local_loads"}
end

local charts = {} -- for the page

local function draw(name, series, options)
  command.chart(("%s/%s"):format(args.out, name), series, options)
  charts[#charts + 1] = {series, options}
end

local function draw_errors(levels)
  local last, low, high = levels[#levels], 100 * levels[#levels].kept, 100 * levels[1].kept
  local function line(name, error_of, cost)
    local series = {name = name, points = {}}
    for _, entry in ipairs(levels) do
      local y = error_of(entry)
      if y and y > 0 then
        table.insert(series.points, {100 * entry.kept, 100 * y, label = cost and
          ("%.2g"):format(entry.certificate.cost_ratio)})
      end
    end
    return #series.points > 0 and series or nil
  end
  local all = {
    line("f1..10", function(e) return e.certificate.f1_10_error end,
      true),
    line("f11..20", function(e) return e.certificate.f11_20_error end),
    line("smooth loads", function(e) return e.certificate.fitted_load_error end),
    line("local loads", function(e) return e.certificate.held_out_load_error end),
    line("worst local load", function(e)
      return e.worst_local and math.abs(e.worst_local.error)
    end),
  }
  local series = {}
  for i = 1, 5 do series[#series + 1] = all[i] end
  local without = {
    name = ("f1..10, costliest %g %% left out"):format(100 * args.leave_out), points = {},
    joined = false,
  }
  for _, entry in ipairs(levels) do
    if entry.without then
      table.insert(without.points,
        {100 * entry.without.kept, 100 * entry.without.certificate.f1_10_error})
    end
  end
  if #without.points > 0 then series[#series + 1] = without end
  series[#series + 1] = {name = ("tolerance %g %%"):format(100 * tolerance), points = {
    {low, 100 * tolerance}, {high, 100 * tolerance}}}
  draw("errors", series, {
    title = ("Where to stop: %s, %d to %d nodes"):format(command.base_name(args.asset),
      levels[1].nodes, last.nodes),
    x_label = "nodes kept (% of the base's); numbers: cost over the base's",
    y_label = "mean error relative to the base (%)",
    log_y = true,
  })
end

-- Costs are contributions to the mean |ln| of the ratios of frequencies, which large errors of
-- f1..10 differ from, so people see them as shares of their sum [%].
local function share(entry, merge) return 100 * merge.frequencies / entry.step.frequency_error end

-- Cumulative share of the merges of a level in its error, costliest first, for at most five levels.
local function draw_merges(levels)
  local series, most = {}, 5
  local stride = math.max(1, math.ceil(#levels / most))
  for i = #levels, 1, -stride do
    local entry, sum = levels[i], 0
    local points, count = {{0, 0}}, #entry.merged
    for rank, merge in ipairs(entry.merged) do
      sum = sum + share(entry, merge)
      -- About twenty points, so that the symbols stay apart.
      if rank == count or rank * 20 // count > (rank - 1) * 20 // count then
        points[#points + 1] = {100 * rank / count, sum}
      end
    end
    series[#series + 1] = {
      name = ("%.0f %% kept, %d merges, error %s"):format(100 * entry.kept, #entry.merged,
        percent(entry.certificate.f1_10_error)),
      points = points,
    }
  end
  draw("costs", series, {
    title = "What the merges of a step add to its error of f1..10, costliest first",
    x_label = "merges (% of all merges of the step)",
    y_label = "sum of their shares (% of the step's error)",
  })
end

local share_label = "share of the merge in the error of f1..10 (%)"

-- The body, with each node coloured by the share of its merge in the error.
local function draw_where(chain, entry)
  local cost, of_node = {}, {}
  for _, merge in ipairs(entry.step.merges) do of_node[merge.node] = share(entry, merge) end
  for i, node in ipairs(chain:group_map(entry.level)) do cost[i] = of_node[node] end
  s.render(args.out .. "/where.png", {chain[0], {chain[0], cut = {0, 1, 0,
    chain[0].center[2]}}}, {
    node_values = cost, value_label = share_label,
    surface = false, nodes = true, titles = {"outside", "cut open"},
    title = ("%d nodes -> %d"):format(chain[0].node_count, entry.nodes), width = 480, height = 400,
  })
  return cost
end

-- Whether a level is more accurate without its costliest merges.
local function helps(entry)
  return entry.without.certificate.f1_10_error < entry.certificate.f1_10_error
end

local cancelling = [[
Where that error is not smaller, merges that make the body softer and merges that make it stiffer
cancel each other; without the costliest ones, the others no longer cancel.]]

local function show(levels)
  local rows = {}
  for i, entry in ipairs(levels) do
    local c, without = entry.certificate, entry.without
    rows[i] = {
      ("%.1f %%"):format(100 * entry.kept), entry.nodes, percent(c.f1_10_error),
      percent(c.f11_20_error), percent(c.fitted_load_error), percent(c.held_out_load_error),
      percent(entry.worst_local and math.abs(entry.worst_local.error)),
      ("%.3g"):format(c.highest_frequency / c.base_highest_frequency),
      ("%.3g"):format(c.cost_ratio), where(entry.merged[1]),
    }
    if without then
      rows[i][11] = ("%s at %d nodes"):format(percent(without.certificate.f1_10_error),
        without.nodes)
    end
  end
  local columns = {
    "kept", "nodes", "f1..10", "f11..20", "smooth loads", "local loads", "worst local",
    "omega_max / base", "cost / base", "costliest merge",
  }
  if builds_without then columns[11] = ("f1..10 without %g %%"):format(100 * args.leave_out) end
  print(split_table.format(rows, columns, 2))
  local meanings = {[[
kept: nodes over those of the base. f1..10, f11..20: errors of natural frequencies; loads: errors of
compliance, worst local: the largest of them. omega_max: highest frequency; cost: spring updates.]]}
  if builds_without then
    meanings[2] = ([[
f1..10 without %g %%: the same level without the costliest %g %% of its merges.]]):format(
      100 * args.leave_out, 100 * args.leave_out)
  end
  for _, entry in ipairs(levels) do
    if entry.without and not helps(entry) then meanings[3] = cancelling end
  end
  print(table.concat(meanings, "\n"))
  return {title = "Errors of the levels", rows = rows, columns = columns,
          note = (table.concat(meanings, " "):gsub("\n", " "))}
end

-- The last level before the tolerance is first exceeded, and the level that exceeds it.
local function find_stop(levels)
  local stop
  for _, entry in ipairs(levels) do
    if entry.certificate.f1_10_error > tolerance then return stop, entry end
    stop = entry
  end
  return stop, nil
end

-- Prints where to stop and why, and returns the lines for readers of the page.
local function advise(stop, beyond)
  local lines = {}
  local function tell(line)
    print(line)
    lines[#lines + 1] = line
  end
  local wanted = ("f1..10 within %g %%"):format(100 * tolerance)
  local function say_errors(entry)
    local c = entry.certificate
    tell(("  errors: %s (f1..10), %s (smooth loads), %s (local loads)"):format(
      percent(c.f1_10_error), percent(c.fitted_load_error), percent(c.held_out_load_error)))
  end
  local function described(entry)
    return ("%.0f %% (%d nodes), cost %.2g of the base's"):format(100 * entry.kept, entry.nodes,
      entry.certificate.cost_ratio)
  end
  if stop then
    tell(("coarsest level with %s: %s"):format(wanted, described(stop)))
    say_errors(stop)
  else
    tell(("no level has %s%s"):format(wanted,
      args.as_made and "" or "; increase --steps to start closer to the base"))
  end
  if not beyond then
    tell("all levels are within tolerance" .. (args.as_made and "" or "; --least can be lower"))
    return lines
  end
  tell((stop and "next level: " or "finest level: ") .. described(beyond))
  say_errors(beyond)
  tell(("  costliest merge, %.2g %% of the error of f1..10: %s"):format(
    share(beyond, beyond.merged[1]), where(beyond.merged[1])))
  local without = beyond.without
  if without then
    tell(("  without its %d costliest merges (%d nodes): %s (f1..10)%s, cost %.2g"):format(
      without.count, without.nodes, percent(without.certificate.f1_10_error),
      helps(beyond) and "" or ", no better", without.certificate.cost_ratio))
  end
  if not args.calibrate and not args.as_made then
    print("--calibrate runs the same analysis on calibrated levels")
  end
  return lines
end

local fit_folder = args.out .. "/unfinished"

-- The levels of the asset, or new ones.
local function make_chain(asset)
  if args.as_made then return s.certify(asset) end
  local steps = args.steps or (args.quick and 3 or 10)
  local fractions = merge_ladder.fractions(asset[0], steps, args.least)
  local chain, shortened = merge_ladder.build(asset[0], fractions, {
    grouping = args.grouping, border = args.border, seed = s.seed, straight = true,
    calibrate = args.calibrate and "modes" or "none",
    calibration = args.calibrate and {store = fit_folder} or nil,
  })
  if shortened then s.say("fewer levels than requested: " .. shortened) end
  return chain
end

-- Lines as sentences: indented ones continue the line before.
local function sentences_of(lines)
  local sentences = {}
  for _, line in ipairs(lines) do
    if line:find("^ ") then
      sentences[#sentences] = sentences[#sentences] .. "; " .. line:gsub("^ +", "")
    else
      sentences[#sentences + 1] = line:sub(1, 1):upper() .. line:sub(2)
    end
  end
  for i, sentence in ipairs(sentences) do sentences[i] = sentence .. "." end
  return sentences
end

local function write_page(chain, advice, shown, cost)
  page.write(args.out .. "/index.html", {
    command = "mergelog", title = "Where to stop merging " .. command.base_name(args.asset),
    verdict = sentences_of(advice), view = s.view(chain), charts = charts, tables = {shown},
    values = {label = share_label, of = {base = cost}},
    pictures = {{path = args.out .. "/where.png", caption = "What each merge adds to the error"}},
    line = command.line(), provenance = page.provenance(chain, {
      {"asset", ("%s (hash %s)"):format(args.asset, s.hash{file = args.asset})},
      {"tolerance", tostring(tolerance)}}),
  })
end

local function merge_log()
  local chain = make_chain(s.load(args.asset))
  local levels = measure(chain)
  local rows = {}
  for i, entry in ipairs(levels) do rows[i] = level_row(entry) end
  s.csv(args.out .. "/levels.csv", rows, {columns = level_columns})
  for name, make in pairs{answers = answer_rows, merges = merge_rows} do
    local list, columns = make(levels)
    s.csv(("%s/%s.csv"):format(args.out, name), list, {columns = columns})
  end
  local shown = show(levels)
  print()
  local stop, beyond = find_stop(levels)
  local advice = advise(stop, beyond)
  draw_errors(levels)
  draw_merges(levels)
  local cost = draw_where(chain, beyond or levels[#levels])
  write_page(chain, advice, shown, cost)
  fit_store.remove(fit_folder)
end

local ok, failure = command.try_in(args.out, merge_log, args.calibrate)
if not ok then command.fail("mergelog: %s", failure) end
s.say("wrote " .. args.out)
