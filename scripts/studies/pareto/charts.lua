-- Charts of cost against error: the colour shows calibration and contact, the symbol the grouping,
-- rings the paper's variants. Points on the Pareto front are labelled.

local s = require "springlod"
local command = require "lib.command"
local pareto_front = require "studies.pareto.front"

local pareto_charts = {}

-- Colours of the calibrations with each contact and symbols of the groupings, in the order of
-- s.choices.
local function look_of(calibration, contact) return calibration .. " " .. contact end
local colours, calibration_names = {}, {}
for i, calibration in ipairs(s.choices.calibrate) do
  for k, contact in ipairs(s.choices.contact) do
    local look = look_of(calibration, contact)
    colours[look] = ({{"orange", "amber"}, {"pink", "green"}, {"blue", "sky"}})[i][k]
    table.insert(calibration_names, {look, ("%s calibrated%s"):format(
      i == 1 and "not" or calibration, contact == "nodes" and "" or ", contact at the surface")})
  end
end
local symbols, symbol_of = {}, {}
for i, grouping in ipairs(s.choices.grouping) do
  local symbol = ({"disc", "square", "triangle_down", "triangle", "diamond"})[i] or "pentagon"
  symbols[i] = {grouping, symbol}
  symbol_of[grouping] = symbol
end

-- Errors below this fraction of the noise floor are indistinguishable: their points are drawn on
-- the lower end of the axis.
local below_floor = 0.1
-- And those of the base whose errors are below this fraction of the least one of a level.
local below_levels = 0.01
local below_least = 0.5 -- start of the axis, as a fraction of the least distinguishable error
local early = 1e-3 -- start of the axis over time, as a fraction of floor or least error
local colour_count = 7 -- size of the default palette; further lines are dashed

-- The points of one error axis: x, y, the variant, and cost and error with their intervals.
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

-- The front as a descending step function, which ends at the first point on the axis.
local function staircase(front, y_from)
  local line = {}
  for i, point in ipairs(front) do
    if i > 1 then line[#line + 1] = {point.x, front[i - 1].y} end
    line[#line + 1] = {point.x, math.max(point.y, y_from)}
    if point.y <= y_from then break end
  end
  return line
end

-- The least error above `limit` of the points that counts(point) is true of; nil if there is none.
local function least_error(points, limit, counts)
  local least
  for _, point in ipairs(points) do
    if point.y > limit and counts(point) then least = math.min(least or point.y, point.y) end
  end
  return least
end

-- The lower end of the error axis.
local function axis_from(points, floor)
  local function is_level(point) return point.variant.level > 0 end
  local limit = below_floor * (floor or 0)
  limit = math.max(limit, below_levels * (least_error(points, limit, is_level) or 0))
  local least = least_error(points, limit, function() return true end)
  return math.max(limit, below_least * (least or 0))
end

local function floor_line(points, floor)
  local low, high = math.huge, 0
  for _, point in ipairs(points) do
    low, high = math.min(low, point.cost.low), math.max(high, point.cost.high)
  end
  return {{low, floor}, {high, floor}}
end

-- The legend: a line for each calibration, a grey symbol for each grouping.
local function add_legend(series, points)
  local seen = {}
  for _, point in ipairs(points) do
    local making = point.variant.making
    if making.grouping then
      seen[making.grouping] = true
      seen[look_of(making.calibration, point.variant.stepping.contact)] = true
    end
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

-- One series per grouping, calibration and contact, and the points of the paper's variants. `front`
-- is a set of points; these and the base are labelled. Points at or below `y_from` are drawn only
-- if they are on the front.
local function series_of(points, front, y_from)
  local series, of_look, paper = {}, {}, {}
  for _, point in ipairs(points) do
    local variant = point.variant
    local making = variant.making
    local colour = making.grouping
      and colours[look_of(making.calibration, variant.stepping.contact)] or "grey"
    local look = (making.grouping or "base") .. colour
    if not of_look[look] then
      of_look[look] = {points = {}, joined = false, colour = colour,
                       symbol = symbol_of[making.grouping] or "pentagon"}
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

-- Draws all points and the front of one axis to folder/NAME.svg and .png. Returns the front, and
-- what was drawn: {series, options} as for s.chart, or nil without points.
-- `axis`: name, title, x_label, y_label, floor (nil if there is none) and floor_name.
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
    local seen = axis.floor > y_from -- otherwise only the legend shows it
    add{name = ("%s: %.2g%s"):format(axis.floor_name, axis.floor, seen and "" or " (below)"),
        points = seen and floor_line(points, axis.floor) or {}, symbol = "none", colour = "green",
        dashed = true}
  end
  local options = {
    title = axis.title, x_label = axis.x_label, y_label = axis.y_label, log_x = true, log_y = true,
    y_from = y_from, width = 1200, height = 800,
  }
  command.chart(folder .. "/" .. axis.name, series, options)
  return front, {series, options}
end

-- Draws surface error over time for the variants on a front, and for the noise floor.
function pareto_charts.draw_over_time(folder, front, floor, title)
  local series, least = {}, axis_from(front, floor.value)
  for _, point in ipairs(front) do
    if point.y > least then
      series[#series + 1] = {name = point.variant.label, points = point.error.curve,
                             symbol = "none", dashed = #series >= colour_count}
    end
  end
  series[#series + 1] = {name = "base, half the step", points = floor.curve, symbol = "none",
                         dashed = true, colour = "black"}
  command.chart(folder .. "/surface-over-time", series, {
    title = title, x_label = "time [s]",
    y_label = "distance of surfaces, rms [% of the base's size]", log_y = true,
    y_from = early * math.max(floor.value, least), width = 1000,
  })
end

return pareto_charts
