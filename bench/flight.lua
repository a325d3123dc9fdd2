-- Times of steps in flight against those that sim/fast/step_time.cpp predicts, and the constants of
-- that prediction, fitted to the times.

local flight = {}

local benchmark = "^flight/([%w_]+)/(%d)/(f%d+)$"

-- Bodies with more nodes are left out of the fit: their data do not stay in the caches.
local most_nodes = 20000

-- The solution of the n x n linear system a x = b, by elimination with pivots.
local function solved(a, b)
  local n = #b
  for i = 1, n do
    local pivot = i
    for k = i + 1, n do
      if math.abs(a[k][i]) > math.abs(a[pivot][i]) then pivot = k end
    end
    a[i], a[pivot], b[i], b[pivot] = a[pivot], a[i], b[pivot], b[i]
    for k = 1, n do
      if k ~= i then
        local factor = a[k][i] / a[i][i]
        for j = i, n do a[k][j] = a[k][j] - factor * a[i][j] end
        b[k] = b[k] - factor * b[i]
      end
    end
  end
  local x = {}
  for i = 1, n do x[i] = b[i] / a[i][i] end
  return x
end

-- Times per step, node and eight [ns] for which the sum of squares of the relative errors is least.
local function fitted(rows)
  local a, b = {{0, 0, 0}, {0, 0, 0}, {0, 0, 0}}, {0, 0, 0}
  for _, row in ipairs(rows) do
    local c = row.counters
    local terms = {1 / c.ns_per_step, c.work_nodes / c.ns_per_step, c.work_eights / c.ns_per_step}
    for i = 1, 3 do
      b[i] = b[i] + terms[i]
      for j = 1, 3 do a[i][j] = a[i][j] + terms[i] * terms[j] end
    end
  end
  return solved(a, b)
end

-- For each kernel and precision, the constants of step_time.cpp and the number of models.
flight.fit_columns = {"kernel", "models", "ns per step", "ns per node", "ns per eight"}
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
