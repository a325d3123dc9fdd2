-- Errors, orders of convergence and verdicts of the validation, as tables, charts and a page.

local s = require "springlod"
local command = require "lib.command"

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
local function series(quantity, number, rows, level, judged)
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

-- A problem with its entries. `judged`: whether the goals are for these sizes.
function report.page(problem, rows, judged)
  local levels, entries = 0, {}
  for _, row in ipairs(rows) do levels = math.max(levels, row.level) end
  for number, quantity in ipairs(problem.quantities) do
    for level = 0, levels do
      local list = series(quantity, number, rows, level, judged)
      table.move(list, 1, #list, #entries + 1, entries)
    end
  end
  return {problem = problem, entries = entries}
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

local function columns_of(problem)
  return {"quantity", "model", problem.size_name, "nodes", "value", "error", "order", "goal",
          "within"}
end

local function references(problem)
  local list = {}
  for i, quantity in ipairs(problem.quantities) do
    list[i] = ("%s = %.6g"):format(quantity.name, quantity.reference)
  end
  return table.concat(list, ", ")
end

function report.print(pages)
  for _, page in ipairs(pages) do
    local rows = {}
    for i, entry in ipairs(page.entries) do rows[i] = cells_of(entry) end
    print(("\n%s (%s)"):format(page.problem.title, references(page.problem)))
    print(s.format_table(rows, {columns = columns_of(page.problem)}))
  end
end

local function markdown_row(cells)
  local texts = {}
  for i, cell in ipairs(cells) do texts[i] = tostring(cell) end
  return "| " .. table.concat(texts, " | ") .. " |"
end

local function markdown_table(columns, rows)
  local lines = {markdown_row(columns), "|" .. ("---|"):rep(#columns)}
  for _, row in ipairs(rows) do lines[#lines + 1] = markdown_row(row) end
  return table.concat(lines, "\n")
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
  local problem, rows = page.problem, {}
  for i, entry in ipairs(page.entries) do rows[i] = cells_of(entry) end
  local lines = {"## " .. problem.title, "", problem.text, "",
    ("Reference: %s %s."):format(problem.source, references(problem)), "",
    markdown_table(columns_of(problem), rows), ""}
  if has_chart(page) then
    lines[#lines + 1] = ("![%s: error against cell size](images/%s.png)\n"):format(problem.title,
      chart_name(problem))
  end
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
problem is solved by the base at three cell sizes, and by two levels with 45 % and 20 % of its
nodes, fitted by default, whose contact points are on the base's surface. All bodies have Poisson's
ratio 1/4 and no damping. A goal is for the finest size. The order is the order of convergence from
the size before. "Not found" means that a small model has no mode of this kind among its lowest.

]]

local function page_text(pages)
  local parts = {head .. markdown_table({"problem", "quantity", "model", "size", "error", "goal",
                                         "within"}, verdicts(pages)) .. "\n"}
  for _, page in ipairs(pages) do parts[#parts + 1] = section(page) end
  return table.concat(parts, "\n")
end

local colours = {"blue", "orange", "green", "pink"} -- by quantity
local symbols = {[0] = "disc", "square", "triangle"} -- by level

-- A line for each quantity and level.
local function lines_of(page)
  local lines = {}
  for number, quantity in ipairs(page.problem.quantities) do
    for level = 0, #symbols do
      local points = {}
      for _, entry in ipairs(page.entries) do
        if entry.quantity == quantity and entry.level == level and entry.error then
          points[#points + 1] = {1 / entry.size, math.abs(entry.error)}
        end
      end
      if #points > 0 then
        lines[#lines + 1] = {name = quantity.name .. ", " .. level_name(level), points = points,
          colour = colours[number], symbol = symbols[level], dashed = level > 0}
      end
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
