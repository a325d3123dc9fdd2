-- Times of steps in flight against those that sim/fast/step_time.cpp predicts, and the constants of
-- that prediction, fitted to the times.

local intervals = require "lib.intervals"
local linear = require "lib.linear"

local flight = {}

local benchmark = "^flight/([%w_]+)/(%d)/(f%d+)$"

-- Bodies with more nodes are left out of the fit: their data do not stay in the caches.
local most_nodes = 20000

-- Times per step, node and eight [ns] for which the sum of squares of the relative errors is least,
-- none below 0. In rows, nodes and eights go together, so that the time of a node may come out
-- negative; it is 0 then.
local function fitted(rows, counts)
  counts = counts or {"steps", "work_nodes", "work_eights"}
  local a, b = {}, {}
  for i = 1, #counts do
    a[i], b[i] = {}, 0
    for j = 1, #counts do a[i][j] = 0 end
  end
  for _, row in ipairs(rows) do
    local c, terms = row.counters, {}
    for i, count in ipairs(counts) do terms[i] = (c[count] or 1) / c.ns_per_step end
    for i = 1, #counts do
      b[i] = b[i] + terms[i]
      for j = 1, #counts do a[i][j] = a[i][j] + terms[i] * terms[j] end
    end
  end
  local x = linear.solve(a, b)
  if #counts == 3 and x[2] < 0 then
    local two = fitted(rows, {"steps", "work_eights"})
    return {two[1], 0, two[2]}
  end
  return x
end

-- Least, median and largest ratio of the prediction to the measured time.
local function agreement(rows)
  local ratios = {}
  for i, row in ipairs(rows) do
    ratios[i] = row.counters.predicted_ns / row.counters.ns_per_step
  end
  return intervals.spread(ratios)
end

-- For each kernel and precision, the number of models, the constants of step_time.cpp that fit
-- best, and how well those in use agree.
flight.fit_columns = {"kernel", "models", "ns per step", "ns per node", "ns per eight",
                      "predicted / measured"}
function flight.fit_rows(rows)
  local kinds, order = {}, {}
  for _, row in ipairs(rows) do
    local precision = select(3, row.name:match(benchmark))
    if precision and not row.failed and row.counters.nodes <= most_nodes then
      local key = row.label .. " " .. precision
      if not kinds[key] then
        kinds[key] = {}
        order[#order + 1] = key
      end
      table.insert(kinds[key], row)
    end
  end
  table.sort(order)
  local fits = {}
  for i, key in ipairs(order) do
    local x = fitted(kinds[key])
    fits[i] = {key, #kinds[key]}
    for k = 1, 3 do fits[i][2 + k] = ("%.3g"):format(x[k]) end
    fits[i][6] = agreement(kinds[key])
  end
  return fits
end

-- One row per body, level and precision for a table; see flight.columns.
flight.columns = {"body", "level", "nodes", "springs", "precision", "kernel", "gaps",
                  "measured [us]", "predicted [us]", "predicted / measured"}
function flight.table_rows(rows)
  local list = {}
  for _, row in ipairs(rows) do
    local body, level, precision = row.name:match(benchmark)
    if body and not row.failed then
      local c = row.counters
      list[#list + 1] = {
        (body:gsub("_", " ")), level, ("%d"):format(c.nodes), ("%d"):format(c.springs), precision,
        row.label, ("%.0f %%"):format(100 - 100 * c.springs / (8 * c.work_eights)),
        ("%.3g"):format(c.ns_per_step / 1e3), ("%.3g"):format(c.predicted_ns / 1e3),
        ("%.2f"):format(c.predicted_ns / c.ns_per_step)}
    end
  end
  return list
end

return flight
