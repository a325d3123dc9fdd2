-- Measure the convergence of cantilevers towards Timoshenko's beam with smaller cells.

local s = require "springlod"
local cantilever = require "lib.cantilever"
local command = require "lib.command"
local unit_store = require "lib.unit_store"

local parser = command.parser("refinement", "Measure the convergence of cantilevers (square "
  .. "section, length 20 heights) with decreasing cell size: tip deflection and first three "
  .. "bending frequencies compared with Timoshenko's beam. Writes table.csv, orders.csv, "
  .. "timoshenko.csv, chart.svg and chart.png.")
command.add_out(parser, "out/refinement", "folder", true)
parser:option("--finest", "cells across the finest bar; 16 takes a minute and 3 GB of memory")
  :convert(command.whole("--finest", 3)):default("16")
parser:flag("--quick", "the same as --finest 4; takes seconds")
local args = parser:parse()
if args.quick then args.finest = 4 end

-- Cells across the height. `centers` needs two: a single row of nodes has no bending stiffness. It
-- stops at eight, enough to show its slower convergence.
local sizes = {corners = {1, 2, 3, 4, 6, 8, 12, 16}, centers = {2, 3, 4, 6, 8}}
local styles = {"corners", "centers"}

local poisson = 0.25 -- of springs alone
local names, expected = cantilever.names, cantilever.timoshenko(poisson)

local function measure(style, cells)
  local model = cantilever.model({style = style}, cells, poisson)
  return {style = style, cells = cells, nodes = model.node_count,
          values = cantilever.measure(model, cells)}
end

-- The slope of ln |error| against ln cell size, by least squares.
local function fitted_order(rows, which)
  local n, sx, sy, sxx, sxy = 0, 0, 0, 0, 0
  for _, row in ipairs(rows) do
    local x, y = -math.log(row.cells), math.log(math.abs(row.errors[which]))
    n, sx, sy, sxx, sxy = n + 1, sx + x, sy + y, sxx + x * x, sxy + x * y
  end
  return (n * sxy - sx * sy) / (n * sxx - sx * sx)
end

-- The limit of a series differs slightly from Timoshenko's beam, as the clamp prevents lateral
-- contraction of the end face. Estimates the order of convergence towards this limit, and the error
-- of the limit, from the finest size, its half and its quarter. `centers` is too far from its limit
-- for an estimate.
local function own_limit(rows, which)
  if rows[1].style ~= "corners" then return nil end
  local error_at = {}
  for _, row in ipairs(rows) do error_at[row.cells] = row.errors[which] end
  local finest = rows[#rows].cells
  local fine, middle, coarse = error_at[finest], error_at[finest / 2], error_at[finest / 4]
  if not (middle and coarse) then return nil end
  local ratio = (coarse - middle) / (middle - fine)
  return math.log(ratio, 2), fine - (middle - fine) / (ratio - 1)
end

local function add_errors(row, before)
  row.errors, row.orders = {}, {}
  for i, value in ipairs(row.values) do
    row.errors[i] = 100 * (value / expected[i] - 1)
    if before then
      row.orders[i] = math.log(math.abs(before.errors[i] / row.errors[i]))
        / math.log(row.cells / before.cells)
    end
  end
end

local columns = {"style", "cells", "nodes"}
for _, name in ipairs(names) do columns[#columns + 1] = name .. " [%]" end
for _, name in ipairs(names) do columns[#columns + 1] = name .. " order" end

-- `number` formats a number.
local function cells_of(row, number)
  local list = {row.style, row.cells, row.nodes}
  for _, kind in ipairs{"errors", "orders"} do
    for i = 1, #names do
      list[#list + 1] = row[kind][i] and number(row[kind][i], kind) or ""
    end
  end
  return list
end

local function study(store)
  local rows, of_style = {}, {}
  for _, style in ipairs(styles) do
    of_style[style] = {}
    for _, cells in ipairs(sizes[style]) do
      if cells > args.finest then break end
      local row = store:value(style .. " " .. cells, function() return measure(style, cells) end)
      add_errors(row, of_style[style][#of_style[style]])
      s.say(("%s, %d cells across: deflection error %.2f %%"):format(style, cells, row.errors[1]))
      rows[#rows + 1] = row
      table.insert(of_style[style], row)
    end
  end
  return rows, of_style
end

local order_columns = {"style", "value", "order", "order towards own limit", "own limit [%]"}

local function order_rows(of_style)
  local list = {}
  for _, style in ipairs(styles) do
    for i, name in ipairs(names) do
      local order, limit = own_limit(of_style[style], i)
      list[#list + 1] = {style, name, fitted_order(of_style[style], i), order or "", limit or ""}
    end
  end
  return list
end

local function draw(folder, of_style)
  local series = {}
  local function add(style, which)
    local points = {}
    for i, row in ipairs(of_style[style]) do
      points[i] = {1 / row.cells, math.abs(row.errors[which])}
    end
    series[#series + 1] = {points = points, name = ("%s %s: order %.2f"):format(style,
      names[which], fitted_order(of_style[style], which))}
  end
  for which = 1, #names do add("corners", which) end
  add("centers", 1)
  local finest = of_style.corners[#of_style.corners].cells
  local function guide(x) return {x, 28 * x ^ 2} end -- below all other lines
  series[#series + 1] = {name = "slope of order 2", points = {guide(0.5), guide(1 / finest)}}
  command.chart(folder .. "/chart", series, {
    title = "Cantilever, length 20 heights: error against Timoshenko's beam",
    x_label = "cell / height", y_label = "error of deflection and frequencies [%]",
    log_x = true, log_y = true,
  })
end

local function report(rows, of_style)
  print(("Timoshenko's beam, k = %.4f: tip %.5g m/N; f1 %.5g, f2 %.5g, f3 %.5g Hz"):format(
    cantilever.shear_coefficient(poisson), table.unpack(expected)))
  print("The clamp holds all nodes of the end face, which therefore cannot contract.")
  local texts = {}
  for i, row in ipairs(rows) do
    texts[i] = cells_of(row, function(x, kind)
      return (kind == "errors" and "%+.2f" or "%.2f"):format(x)
    end)
  end
  print(s.format_table(texts, {columns = columns}))
  print()
  local orders = order_rows(of_style)
  for _, row in ipairs(orders) do
    for i = 3, 5 do row[i] = row[i] ~= "" and ("%.2f"):format(row[i]) or "" end
  end
  print(s.format_table(orders, {columns = order_columns}))
  print([[
cells: across the height. tip: deflection under a force; f1 to f3: frequencies of bending; errors
against the beam. order: of convergence, from the size before, and over all sizes in the second
table. own limit: the error at which the finest sizes would end, and the order towards it.]])
end

local ok, failure = command.try_in(args.folder, function()
  local store = unit_store.open(args.folder, {})
  local rows, of_style = study(store)
  local exact = {}
  for i, row in ipairs(rows) do exact[i] = cells_of(row, function(x) return x end) end
  s.csv(args.folder .. "/table.csv", exact, {columns = columns})
  s.csv(args.folder .. "/timoshenko.csv", {expected},
    {columns = {"tip [m/N]", "f1 [Hz]", "f2 [Hz]", "f3 [Hz]"}})
  s.csv(args.folder .. "/orders.csv", order_rows(of_style), {columns = order_columns})
  draw(args.folder, of_style)
  report(rows, of_style)
  store:remove()
end, true)
if not ok then command.fail("refinement: %s", failure) end
s.say("wrote " .. args.folder)
