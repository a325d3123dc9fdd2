-- Tables with many columns for a terminal: several tables of at most 100 columns, one below the
-- other, each with the first columns, which name its rows.

local s = require "springlod"

local split_table = {}

local widest, gap = 100, 2 -- as s.format_table [characters]

-- Width that a column needs: of its cells, and of the longest word of its name, which may wrap.
local function width_of(rows, columns, k)
  local width = 0
  for word in columns[k]:gmatch("%S+") do width = math.max(width, utf8.len(word)) end
  for _, row in ipairs(rows) do width = math.max(width, utf8.len(tostring(row[k] or ""))) end
  return width
end

-- Lists of columns that fit. `keys`: how many of the first columns each begins with.
local function parts_of(rows, columns, keys)
  local parts, room, width_of_keys = {}, 0, -gap
  for k = 1, keys do width_of_keys = width_of_keys + gap + width_of(rows, columns, k) end
  for k = keys + 1, #columns do
    local width = gap + width_of(rows, columns, k)
    if #parts == 0 or width > room then
      local part = {}
      for key = 1, keys do part[key] = key end
      parts[#parts + 1], room = part, widest - width_of_keys
    end
    table.insert(parts[#parts], k)
    room = room - width
  end
  return parts
end

-- `rows`: lists of texts and integers.
function split_table.format(rows, columns, keys)
  local texts = {}
  for i, part in ipairs(parts_of(rows, columns, keys)) do
    local cells, names = {}, {}
    for _, k in ipairs(part) do names[#names + 1] = columns[k] end
    for r, row in ipairs(rows) do
      cells[r] = {}
      for _, k in ipairs(part) do table.insert(cells[r], row[k] or "") end
    end
    texts[i] = s.format_table(cells, {columns = names})
  end
  return table.concat(texts, "\n\n")
end

return split_table
