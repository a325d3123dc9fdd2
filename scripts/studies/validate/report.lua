-- Errors, orders of convergence and verdicts of the validation, as tables, charts and a page.

local s = require "springlod"
local command = require "lib.command"
local markdown = require "lib.markdown"

local report = {}

local function level_name(level) return level == 0 and "base" or "level " .. level end

-- Error in percent; for a quantity that should vanish, its size.
local function error_of(quantity, value)
  if not value then return nil end
  if quantity.reference == 0 then return math.abs(value) end
  return 100 * (value / quantity.reference - 1)
end

local function goal_of(quantity, level)
  if level == 0 then return quantity.goal end
  return quantity.level_goals and quantity.level_goals[level]
end

-- Order of convergence between two sizes; nil unless both errors are on the same side.
local function order_of(coarse, fine)
  if not (coarse and coarse.error and fine.error) then return nil end
  if coarse.error * fine.error <= 0 then return nil end
  return math.log(math.abs(coarse.error / fine.error)) / math.log(fine.size / coarse.size)
end

-- The entries of one quantity at one level, by size. If `judged`, the finest has a verdict: "yes",
-- "no", or nothing without a goal.
local function series_of(quantity, number, rows, level, judged)
  local list = {}
  for _, row in ipairs(rows) do
    if row.level == level then
      local value = row.values[number]
      local entry = {size = row.size, nodes = row.nodes, level = level, quantity = quantity,
                     value = value, error = error_of(quantity, value)}
      if quantity.reference ~= 0 then entry.order = order_of(list[#list], entry) end
      list[#list + 1] = entry
    end
  end
  local last, goal = list[#list], judged and goal_of(quantity, level)
  if goal then
    last.goal = goal
    last.verdict = last.error and math.abs(last.error) <= goal and "yes" or "no"
  end
  return list
end

-- A problem with its entries, in one list, and by quantity and level (`series`, a list of lists).
-- `judged`: whether the goals are for these sizes.
function report.page(problem, rows, judged)
  local page, levels = {problem = problem, entries = {}, series = {}}, 0
  for _, row in ipairs(rows) do levels = math.max(levels, row.level) end
  for number, quantity in ipairs(problem.quantities) do
    for level = 0, levels do
      local list = series_of(quantity, number, rows, level, judged)
      page.series[#page.series + 1] = list
      table.move(list, 1, #list, #page.entries + 1, page.entries)
    end
  end
  return page
end

local function value_text(entry)
  return entry.value and ("%.5g"):format(entry.value) or "not found"
end

local function error_text(entry)
  if not entry.error then return "-" end
  if entry.quantity.reference == 0 then return "" end
  return (math.abs(entry.error) < 1 and "%+.2f %%" or "%+.1f %%"):format(entry.error)
end

local function goal_text(entry)
  if not entry.goal then return "" end
  return entry.quantity.reference == 0 and ("%g"):format(entry.goal) or ("%g %%"):format(entry.goal)
end

local function cells_of(entry)
  return {entry.quantity.name, level_name(entry.level), entry.size, entry.nodes, value_text(entry),
          error_text(entry), entry.order and ("%.2f"):format(entry.order) or "", goal_text(entry),
          entry.verdict or ""}
end

-- The rows of a page's table, and its columns.
local function table_of(page)
  local rows = {}
  for i, entry in ipairs(page.entries) do rows[i] = cells_of(entry) end
  return rows, {"quantity", "model", page.problem.size_name, "nodes", "value", "error", "order",
                "goal", "within"}
end

local function references(problem)
  local list = {}
  for _, quantity in ipairs(problem.quantities) do
    if quantity.reference ~= 0 then
      list[#list + 1] = ("%s = %.6g"):format(quantity.name, quantity.reference)
    end
  end
  return table.concat(list, ", ")
end

-- A list in lines of at most 100 characters, cut after commas.
local function folded(text)
  local lines, line = {}, ""
  for item in text:gmatch("[^,]+,? ?") do
    if utf8.len(line .. item) > 100 then
      lines[#lines + 1], line = line:gsub(" $", ""), "  "
    end
    line = line .. item
  end
  lines[#lines + 1] = line
  return table.concat(lines, "\n")
end

function report.print(pages)
  for _, page in ipairs(pages) do
    local rows, columns = table_of(page)
    local known = references(page.problem)
    print("\n" .. page.problem.title)
    if known ~= "" then print(folded("known: " .. known)) end
    for i, entry in ipairs(page.entries) do
      -- What should vanish is an error, of which two digits mean something.
      if entry.value and entry.quantity.reference == 0 then
        rows[i][5] = ("%.2g"):format(entry.value)
      end
    end
    print(s.format_table(rows, {columns = columns}))
  end
  print([[

error: against the known answer; quantities without a known value are errors themselves. order: of
convergence from the size before. goal: largest error that is good enough; within: whether it is.]])
end

local function chart_name(problem) return "validation-" .. problem.name end

-- Whether the errors of a problem can be drawn over the size.
local function has_chart(page)
  for _, entry in ipairs(page.entries) do
    if entry.order then return true end
  end
  return false
end

local function section(page)
  local problem = page.problem
  local known = references(problem)
  local lines = {"## " .. problem.title, "", problem.text, "",
    "Reference: " .. problem.source .. (known ~= "" and (" %s."):format(known) or ""), "",
    markdown.table(table_of(page)), ""}
  if has_chart(page) then
    lines[#lines + 1] = ("![%s: error against cell size](images/%s.png)\n"):format(problem.title,
      chart_name(problem))
  end
  if problem.notes then lines[#lines + 1] = problem.notes end
  return table.concat(lines, "\n")
end

-- The judged entries of all pages.
local function verdicts(pages)
  local rows = {}
  for _, page in ipairs(pages) do
    for _, entry in ipairs(page.entries) do
      if entry.verdict then
        rows[#rows + 1] = {page.problem.title, entry.quantity.name, level_name(entry.level),
          ("%d %s"):format(entry.size, page.problem.size_name),
          entry.quantity.reference == 0 and value_text(entry) or error_text(entry),
          goal_text(entry), entry.verdict}
      end
    end
  end
  return rows
end

local head = [[
# Known answers

```sh
springlod validate -o out/validation
```

This command solves problems of mechanics whose answer is known, and writes this page. Each
problem is solved by the base at several cell sizes, and by two levels with 45 % and 20 % of its
nodes, whose contact points are on the base's surface. Unless the problem says otherwise, levels are
fitted with the default options, and bodies have Poisson's ratio 1/4. Bodies have no damping. A goal
is for the finest size. The order is the order of convergence from the size before. "Not found"
means that a small model has no mode of this kind among its lowest.

]]

local function page_text(pages)
  local parts = {head .. markdown.table(verdicts(pages), {"problem", "quantity", "model", "size",
    "error", "goal", "within"}) .. "\n"}
  for _, page in ipairs(pages) do parts[#parts + 1] = section(page) end
  return table.concat(parts, "\n")
end

local colours = {"blue", "orange", "green", "pink"} -- of the quantities
local symbols = {[0] = "disc", "square", "triangle"} -- by level

-- A line for each series that has errors.
local function lines_of(page)
  local lines, colour_of = {}, {}
  for i, quantity in ipairs(page.problem.quantities) do colour_of[quantity] = colours[i] end
  for _, list in ipairs(page.series) do
    local quantity, level, points = list[1].quantity, list[1].level, {}
    for _, entry in ipairs(list) do
      if entry.error then points[#points + 1] = {1 / entry.size, math.abs(entry.error)} end
    end
    if #points > 0 then
      lines[#lines + 1] = {name = quantity.name .. ", " .. level_name(level), points = points,
        colour = colour_of[quantity], symbol = symbols[level], dashed = level > 0}
    end
  end
  return lines
end

local function draw(folder, page)
  command.chart(("%s/images/%s"):format(folder, chart_name(page.problem)), lines_of(page), {
    title = page.problem.title, x_label = "1 / " .. page.problem.size_name,
    y_label = "error [%]", log_x = true, log_y = true,
  })
end

-- Writes the page, the table and the charts.
function report.write(folder, pages)
  local rows = {}
  for _, page in ipairs(pages) do
    for _, e in ipairs(page.entries) do
      rows[#rows + 1] = {page.problem.name, e.quantity.name, e.quantity.reference, e.level, e.size,
        e.nodes, e.value or "", e.error or "", e.order or "", e.goal or "", e.verdict or ""}
    end
    if has_chart(page) then draw(folder, page) end
  end
  s.csv(folder .. "/table.csv", rows, {columns = {"problem", "quantity", "reference", "level",
    "size", "nodes", "value", "error", "order", "goal", "within"}})
  s.save_text(folder .. "/validation.md", page_text(pages))
end

return report
