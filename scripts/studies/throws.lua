-- Throw random bodies at obstacles and count those that turn inside out.

local s = require "springlod"
local command = require "lib.command"
local draw = require "studies.throws.draw"
local measure = require "studies.throws.measure"
local progress = require "lib.progress"
local summary = require "studies.throws.summary"
local unit_store = require "lib.unit_store"

local parser = command.parser("throws", "Throw random bodies at a floor and a wall, at every "
  .. "level, and count inverted corners (J <= 0) at the end and on the way, failed runs and errors "
  .. "of the energy ledger. A throw depends on --seed and its number alone. Writes throws.csv (a "
  .. "row per throw and level), summary.md, chart.svg and chart.png.")
command.add_out(parser, "out/throws")
parser:option("--count", "number of throws (default: 1000; --quick: 12)")
  :convert(command.whole("--count", 1))
parser:option("--first", "number of the first throw"):argname("<number>"):default("1")
  :convert(command.whole("--first", 1))
parser:option("--only", "make one throw, print its course and write nothing"):argname("<number>")
  :convert(command.whole("--only", 1))
parser:flag("--quick", "use fewer throws, of small bodies; takes seconds")
parser:flag("--no-volumes", "corners exert no force; they are still counted")
local args = parser:parse()

-- Numbers of cells, see studies/throws/draw.lua.
local cells = args.quick and {fewest = 150, small = 200, most = 400}
  or {fewest = 300, small = 600, most = 2000}
local options = {}
if args.no_volumes then options.volumes = false end

local function repeated()
  return ("springlod throws --seed %d%s%s --only N"):format(s.seed,
    args.quick and " --quick" or "", args.no_volumes and " --no-volumes" or "")
end

local function tell(number)
  local throw = draw(s.seed, number, cells)
  local runs = {}
  local rows = measure.throw(throw, options, function(row, model, run)
    runs[row] = summary.timeline(model, run)
  end)
  print(summary.description(throw))
  for _, row in ipairs(rows) do
    if not row.level then
      print("\nnot built: " .. row.message)
    elseif row.error then
      print(("\nlevel %d, %d nodes: %s"):format(row.level, row.nodes, row.message))
    else
      print(("\nlevel %d, %d nodes, %d corners: inverted %d at the end, at most %d%s; volume %s; "
        .. "ledger error %.2g %%, of the scheme %.2g %%; %d steps of %.3g s, shortest %.3g s\n")
        :format(row.level, row.nodes, row.corners, row.inverted_at_end, row.most_inverted,
        row.first_inversion ~= "" and (", first at %.4g s"):format(row.first_inversion) or "",
        row.volume_ratio ~= "" and ("%.1f %%"):format(100 * row.volume_ratio) or "unknown",
        100 * row.ledger_error, 100 * row.scheme_error, row.steps, row.step, row.shortest_step))
      print(runs[row])
    end
  end
end

local function study()
  local rows, count = {}, args.count or (args.quick and 12 or 1000)
  local store = unit_store.open(args.out, {cells = cells, options = options})
  local report = progress(count)
  for number = args.first, args.first + count - 1 do
    local throw = draw(s.seed, number, cells)
    local kept = store:value(number, function()
      return {rows = measure.throw(throw, options), cells = throw.cells}
    end)
    throw.cells = kept.cells -- measure.throw sets it
    for _, row in ipairs(kept.rows) do
      row.throw = throw
      rows[#rows + 1] = row
    end
    report(("throw %d: %s"):format(number, throw.shape))
  end
  s.csv(args.out .. "/throws.csv", summary.cells(rows), {columns = summary.columns})
  summary.publish(args.out .. "/summary.md", rows, repeated())
  summary.chart(args.out .. "/chart", rows)
  store:remove()
  s.say("wrote " .. args.out)
end

local ok, failure
if args.only then
  ok, failure = command.try(tell, args.only)
else
  ok, failure = command.try_in(args.out, study, true)
end
if not ok then command.fail("throws: %s", failure) end
