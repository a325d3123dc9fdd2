-- Tables as Markdown.

local markdown = {}

local function line(cells) return "| " .. table.concat(cells, " | ") .. " |" end

-- Lists of texts and numbers, under the names of the columns. Without a line break at the end.
function markdown.table(rows, columns)
  local lines = {line(columns), "|" .. ("---|"):rep(#columns)}
  for _, row in ipairs(rows) do lines[#lines + 1] = line(row) end
  return table.concat(lines, "\n")
end

return markdown
