-- Trade-off between accuracy and cost: errors of levels against their cost reduction.

local s = require "springlod"

local trade_off = {}

trade_off.keep = {0.8, 0.6, 0.45, 0.3, 0.2, 0.1} -- fractions of the nodes of the base
trade_off.methods = {"compact plain", "compact calibrated"}

local lines = {
  {method = "compact plain", measure = "held-out loads", colour = "orange", dashed = true},
  {method = "compact calibrated", measure = "held-out loads", colour = "orange"},
  {method = "compact plain", measure = "f11..20", colour = "sky", dashed = true},
  {method = "compact calibrated", measure = "f11..20", colour = "sky"},
  {method = "compact plain", measure = "f1..10", colour = "blue", dashed = true},
  {method = "compact calibrated", measure = "f1..10", colour = "blue"},
}

-- Writes PATH.svg and PATH.png. mean_of(level, method, measure) returns the mean, or nil if it was
-- not measured. `note`: after the title.
function trade_off.chart(path, mean_of, note)
  local series = {}
  for i, line in ipairs(lines) do
    local points = {}
    for level, share in ipairs(trade_off.keep) do
      local cost = mean_of(level, line.method, "base cost/cost")
      if cost then
        points[#points + 1] = {cost, mean_of(level, line.method, line.measure),
                               label = i == 2 and ("%g %%"):format(100 * share) or nil}
      end
    end
    series[i] = {name = ("%s, %s"):format(line.measure, line.method:match("%a+$")),
                 points = points, colour = line.colour, dashed = line.dashed}
  end
  for _, ending in ipairs{".svg", ".png"} do
    s.chart(path .. ending, series, {
      title = "What smaller levels cost in accuracy" .. note,
      x_label = "base cost / cost of a simulated second (springs over stable step)",
      y_label = "error [%]",
      log_x = true,
      log_y = true,
      y_from = 0.1,
    })
  end
end

return trade_off
