-- Cost against error as a chart: colour tells the calibration, symbol the grouping, rings the
-- paper's variants; the points of the front have names.

local s = require "springlod"
local command = require "lib.command"
local pareto_front = require "studies.pareto.front"

local pareto_charts = {}

-- Colours of the calibrations and symbols of the groupings, in the order of s.choices.
local colours, calibration_names = {}, {}
for i, calibration in ipairs(s.choices.calibrate) do
  colours[calibration] = ({"orange", "pink", "blue"})[i]
  calibration_names[i] = {calibration, (i == 1 and "not" or calibration) .. " calibrated"}
end
local symbols, symbol_of = {}, {}
for i, grouping in ipairs(s.choices.grouping) do
  local symbol = ({"disc", "square", "triangle_down", "triangle", "diamond"})[i] or "pentagon"
  symbols[i] = {grouping, symbol}
  symbol_of[grouping] = symbol
end

-- Errors this much below the floor are all the same: their points sit on the axis, which begins at
-- this part of the least of the others.
local below_floor = 0.1
local below_least = 0.5
local early = 1e-3 -- of the floor: what is seen of the time before anything is touched
local colour_count = 7 -- that series take by themselves; beyond them lines are dashed

-- Points of an error axis: x and y as {value, low, high}.
local function points_of(variants, axis)
  local points = {}
  for _, variant in ipairs(variants) do
    local error_of, cost = variant.measured[axis.name], variant.measured.cost
    if error_of and cost then
      points[#points + 1] = {x = cost.ratio.value, y = error_of.value, variant = variant,
                             cost = cost.ratio, error = error_of}
    end
  end
  return points
end

local function chart_point(point, label)
  return {point.x, point.y, x_low = point.cost.low, x_high = point.cost.high,
          low = point.error.low, high = point.error.high, label = label or nil}
end

-- Down and to the right from point to point, and down to the axis at the first that sits there.
local function staircase(front, y_from)
  local line = {}
  for i, point in ipairs(front) do
    if i > 1 then line[#line + 1] = {point.x, front[i - 1].y} end
    line[#line + 1] = {point.x, math.max(point.y, y_from)}
    if point.y <= y_from then break end
  end
  return line
end

-- Where the axis of errors begins.
local function axis_from(points, floor)
  local same, least = below_floor * (floor or 0), math.huge
  for _, point in ipairs(points) do
    if point.y > same then least = math.min(least, point.y) end
  end
  return least < math.huge and math.max(same, below_least * least) or same
end

local function floor_line(points, floor)
  local low, high = math.huge, 0
  for _, point in ipairs(points) do
    low, high = math.min(low, point.cost.low), math.max(high, point.cost.high)
  end
  return {{low, floor}, {high, floor}}
end

-- The legend: a line for each colour, a grey symbol for each grouping.
local function add_legend(series, points)
  local seen = {}
  for _, point in ipairs(points) do
    local making = point.variant.making
    seen[making.grouping or "base"] = true
    seen[making.calibration or "base"] = true
  end
  for _, entry in ipairs(calibration_names) do
    if seen[entry[1]] then
      series[#series + 1] = {name = entry[2], points = {}, colour = colours[entry[1]],
                             symbol = "none"}
    end
  end
  for _, entry in ipairs(symbols) do
    if seen[entry[1]] then
      series[#series + 1] = {name = entry[1], points = {}, colour = "grey", symbol = entry[2],
                             joined = false}
    end
  end
  series[#series + 1] = {name = "base", points = {}, colour = "grey", symbol = "pentagon",
                         joined = false}
end

-- A series for each grouping and calibration, and the paper's points. `front`: a set; it and the
-- base have names. Points not above `y_from` are shown if they are in it, so that of what has no
-- error the cheapest is told.
local function series_of(points, front, y_from)
  local series, of_look, paper = {}, {}, {}
  for _, point in ipairs(points) do
    local variant = point.variant
    local making = variant.making
    local look = making.grouping and making.grouping .. making.calibration or "base"
    if not of_look[look] then
      of_look[look] = {
        points = {}, joined = false, symbol = symbol_of[making.grouping] or "pentagon",
        colour = colours[making.calibration] or "grey",
      }
      series[#series + 1] = of_look[look]
    end
    if point.y > y_from or front[point] then
      local named = front[point] or variant.level == 0
      table.insert(of_look[look].points, chart_point(point, named and variant.label))
    end
    if variant.paper then
      paper[#paper + 1] = {point.x, point.y, label = not front[point] and variant.paper or nil}
    end
  end
  return series, paper
end

-- The front of one axis; draws it with all its points as folder/NAME.svg and .png. `axis`: name,
-- title, x_label, y_label, floor (nil if there is none) and its name.
function pareto_charts.draw(folder, variants, axis)
  local points = points_of(variants, axis)
  if #points == 0 then return {} end
  local y_from = axis_from(points, axis.floor)
  local front, on_front = pareto_front(points, below_floor * (axis.floor or 0)), {}
  for _, point in ipairs(front) do on_front[point] = true end
  local series, paper = series_of(points, on_front, y_from)
  local function add(one) series[#series + 1] = one end
  add_legend(series, points)
  add{name = "Pareto front", points = staircase(front, y_from), symbol = "none", colour = "black"}
  if #paper > 0 then
    add{name = "the paper's", points = paper, symbol = "ring", colour = "black", joined = false}
  end
  if axis.floor then
    local seen = axis.floor > y_from -- else the legend alone tells of it
    add{name = ("%s: %.2g%s"):format(axis.floor_name, axis.floor, seen and "" or " (below)"),
        points = seen and floor_line(points, axis.floor) or {}, symbol = "none", colour = "green",
        dashed = true}
  end
  command.chart(folder .. "/" .. axis.name, series, {
    title = axis.title, x_label = axis.x_label, y_label = axis.y_label, log_x = true, log_y = true,
    y_from = y_from, width = 1200, height = 800,
  })
  return front
end

-- The surfaces' way over time of what is on a front, and of the floor.
function pareto_charts.draw_over_time(folder, front, floor, title)
  local series, y_from = {}, below_floor * floor.value
  for _, point in ipairs(front) do
    if point.y > y_from then
      series[#series + 1] = {name = point.variant.label, points = point.error.curve,
                             symbol = "none", dashed = #series >= colour_count}
    end
  end
  series[#series + 1] = {name = "base, half the step", points = floor.curve, symbol = "none",
                         dashed = true, colour = "black"}
  command.chart(folder .. "/surface-over-time", series, {
    title = title, x_label = "time [s]",
    y_label = "distance of surfaces, rms [% of the base's size]", log_y = true,
    y_from = early * floor.value, width = 1000,
  })
end

return pareto_charts
