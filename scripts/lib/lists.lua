-- Lists of records and of words.

local lists = {}

-- The names of records, each its field `name` or its first item.
function lists.names_of(records)
  local names = {}
  for i, one in ipairs(records) do names[i] = one.name or one[1] end
  return names
end

-- The items of all lists, in order.
function lists.joined(...)
  local all = {}
  for _, list in ipairs{...} do table.move(list, 1, #list, #all + 1, all) end
  return all
end

-- The records with the fields named only.
function lists.with_fields(records, names)
  local all = {}
  for i, record in ipairs(records) do
    all[i] = {}
    for _, name in ipairs(names) do all[i][name] = record[name] end
  end
  return all
end

return lists
