-- Measure the convergence of cantilevers towards Timoshenko's beam as cells get smaller.

local s = require "springlod"
local command = require "lib.command"
local unit_store = require "lib.unit_store"

local parser = command.parser("refinement", "Measure the convergence of cantilevers (square "
  .. "section, length 20 heights) with decreasing cell size: tip deflection and first three "
  .. "bending frequencies compared with Timoshenko's beam. Writes table.csv, orders.csv, "
  .. "timoshenko.csv, chart.svg and chart.png.")
parser:argument("folder", "folder to write to"):default("out/refinement")
parser:option("--finest", "cells across the finest bar; 16 takes a minute and 3 GB of memory")
  :convert(command.whole("--finest", 3)):default("16")
parser:flag("--quick", "the same as --finest 4; takes seconds")
local args = parser:parse()
if args.quick then args.finest = 4 end

-- The bar lies along x, is clamped at x = 0 and loaded at x = length [m].
local height, slenderness = 0.1, 20
local length = slenderness * height
local material = {young = 1e7, density = 1000, damping = 0}
local poisson = 0.25 -- the value of all central-force spring lattices
local frequency_count = 3

-- Cells across the height. `centers` needs two: a single row of nodes has no bending stiffness. It
-- stops at eight, enough to show its slower convergence.
local sizes = {corners = {1, 2, 3, 4, 6, 8, 12, 16}, centers = {2, 3, 4, 6, 8}}
local styles = {"corners", "centers"}

-- 1. Timoshenko's beam.

-- Shear coefficient of a rectangle (Cowper 1966).
local shear_coefficient = 10 * (1 + poisson) / (12 + 11 * poisson)
local area, inertia = height ^ 2, height ^ 4 / 12
local bending = material.young * inertia
local shearing = shear_coefficient * material.young / (2 * (1 + poisson)) * area

local function timoshenko_deflection() -- per newton
  return length ^ 3 / (3 * bending) + length / shearing
end

-- Frequency equation of a clamped-free beam with shear and rotary inertia (Huang 1961); its roots
-- are b = omega length^2 sqrt(density area / bending).
local function frequency_equation(b)
  local rotary = inertia / (area * length ^ 2)
  local shear = bending / (shearing * length ^ 2)
  local root = math.sqrt((rotary - shear) ^ 2 + 4 / b ^ 2)
  local alpha = math.sqrt((root - rotary - shear) / 2)
  local beta = math.sqrt((root + rotary + shear) / 2)
  local function cosh(x) return (math.exp(x) + math.exp(-x)) / 2 end
  local function sinh(x) return (math.exp(x) - math.exp(-x)) / 2 end
  return 2 + (b ^ 2 * (rotary - shear) ^ 2 + 2) * cosh(b * alpha) * math.cos(b * beta)
    - b * (rotary + shear) / math.sqrt(1 - b ^ 2 * rotary * shear)
    * sinh(b * alpha) * math.sin(b * beta)
end

local function root_between(f, low, high)
  local rising = f(low) < 0
  for _ = 1, 60 do -- to machine precision
    local middle = (low + high) / 2
    if (f(middle) < 0) == rising then low = middle else high = middle end
  end
  return (low + high) / 2
end

local function timoshenko_frequencies()
  local unit = math.sqrt(bending / (material.density * area)) / length ^ 2 / (2 * math.pi)
  local found = {}
  local step, b = 0.1, 0.1 -- roots lie at 3.5, 21, 58: far apart
  while #found < frequency_count do
    if frequency_equation(b) * frequency_equation(b + step) <= 0 then
      found[#found + 1] = unit * root_between(frequency_equation, b, b + step)
    end
    b = b + step
  end
  return found
end

-- 2. The bar of springs.

local function bar_of_springs(style, cells)
  return s.lattice(s.grid{
    cell = height / cells,
    size = {slenderness * cells, cells, cells},
    materials = {bar = material},
    fill = function() return "bar" end,
  }, {style = style})
end

-- Bending modes come in pairs of equal frequency, as the section is square. Torsion and extension
-- do not move the middle of the end face transversally, which identifies bending.
local function bending_frequencies(model, modes, end_face)
  local found = {}
  for _, mode in ipairs(modes) do
    local across = {0, 0}
    for number, share in pairs(end_face) do
      across[1] = across[1] + share * mode.shape[number][2]
      across[2] = across[2] + share * mode.shape[number][3]
    end
    -- 4 for a slender beam, whose tip amplitude is twice the rms amplitude.
    local tip = (across[1] ^ 2 + across[2] ^ 2) * model.mass
    if tip > 1 then found[#found + 1] = mode.frequency end
  end
  local pairs_of = {}
  for i = 1, frequency_count do
    local one, other = found[2 * i - 1], found[2 * i]
    assert(other and other - one < 1e-3 * one, "bending modes of a square bar come in pairs")
    pairs_of[i] = (one + other) / 2
  end
  return pairs_of
end

local function measure(style, cells)
  local cell = height / cells
  local model = bar_of_springs(style, cells)
  -- The first and the last layer of nodes: on the end faces for `corners`, half a cell inside for
  -- `centers`.
  local function clamped(node) return node.x < 0.75 * cell end
  local function at_end(node) return node.x > length - 0.75 * cell end
  -- The end face: each node with its fraction of the area, which equals that of the volume.
  local end_face, sum = {}, 0
  for _, node in ipairs(model:nodes()) do
    if at_end(node) then
      end_face[node.number] = node.volume
      sum = sum + node.volume
    end
  end
  local force = {}
  for number, volume in pairs(end_face) do
    end_face[number] = volume / sum
    force[number] = {0, 0, volume / sum} -- 1 N in total, evenly distributed
  end
  local bent = s.deflect(model, {anchored = clamped, force = force})
  local deflection = 0
  for number, share in pairs(end_face) do
    deflection = deflection + share * bent.displacement[number][3]
  end
  local modes = s.modes(model, {count = 12, anchored = clamped, seed = s.seed})
  local values = bending_frequencies(model, modes, end_face)
  table.insert(values, 1, deflection)
  return {style = style, cells = cells, nodes = model.node_count, values = values}
end

-- 3. Errors and orders.

local names = {"tip", "f1", "f2", "f3"} -- tip deflection and frequencies
local expected = timoshenko_frequencies()
table.insert(expected, 1, timoshenko_deflection())

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
    shear_coefficient, table.unpack(expected)))
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
