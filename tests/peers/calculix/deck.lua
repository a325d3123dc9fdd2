-- Blocks of hexahedra as decks of CalculiX, and its results.

local deck = {}

-- Nodes of an element, in steps of half a cell, in CalculiX's order: corners, middles of edges.
local corners = {{0, 0, 0}, {2, 0, 0}, {2, 2, 0}, {0, 2, 0},
                 {0, 0, 2}, {2, 0, 2}, {2, 2, 2}, {0, 2, 2}}
local edges = {{1, 2}, {2, 3}, {3, 4}, {4, 1}, {5, 6}, {6, 7}, {7, 8}, {8, 5},
               {1, 5}, {2, 6}, {3, 7}, {4, 8}}
local places = {table.unpack(corners)}
for i, edge in ipairs(edges) do
  local a, b = corners[edge[1]], corners[edge[2]]
  places[8 + i] = {(a[1] + b[1]) // 2, (a[2] + b[2]) // 2, (a[3] + b[3]) // 2}
end

-- Kinds of elements, both integrated fully: trilinear, and quadratic of the serendipity family.
deck.places = {C3D8 = corners, C3D20 = places}

-- A block with `cells` cells per metre. block: size [m], young (material -> [Pa]), poisson,
-- density, material_at(x), kind (default C3D20). Returns
--   lines      of the deck
--   nodes      their places, {x, y, z} [m]
--   elements   list of {x, y, z of the lowest corner [m], nodes = list of numbers}
function deck.mesh(block, cells)
  local kind, size = block.kind or "C3D20", {}
  for d = 1, 3 do size[d] = math.floor(block.size[d] * cells + 0.5) end
  local number_of, nodes, elements, lines_of = {}, {}, {}, {}
  for name in pairs(block.young) do lines_of[name] = {} end
  local function node(i, j, k)
    local key = ((i * (2 * size[2] + 1)) + j) * (2 * size[3] + 1) + k
    if not number_of[key] then
      number_of[key] = #nodes + 1
      nodes[#nodes + 1] = {i / 2 / cells, j / 2 / cells, k / 2 / cells}
    end
    return number_of[key]
  end
  for k = 0, size[3] - 1 do
    for j = 0, size[2] - 1 do
      for i = 0, size[1] - 1 do
        local list = {}
        for n, place in ipairs(deck.places[kind]) do
          list[n] = node(2 * i + place[1], 2 * j + place[2], 2 * k + place[3])
        end
        elements[#elements + 1] = {i / cells, j / cells, k / cells, nodes = list}
        -- Lines have at most 16 entries.
        local line = #elements .. ", " .. table.concat(list, ", ", 1, 8)
        if #list > 8 then line = line .. ",\n" .. table.concat(list, ", ", 9) end
        table.insert(lines_of[block.material_at((i + 0.5) / cells)], line)
      end
    end
  end
  local lines = {"*NODE, NSET=ALL"}
  for number, x in ipairs(nodes) do
    lines[#lines + 1] = ("%d, %.12g, %.12g, %.12g"):format(number, table.unpack(x))
  end
  local names = {}
  for name, of_material in pairs(lines_of) do
    names[#names + 1] = name
    lines[#lines + 1] = ("*ELEMENT, TYPE=%s, ELSET=%s"):format(kind, name)
    lines[#lines + 1] = table.concat(of_material, "\n")
    lines[#lines + 1] = ("*MATERIAL, NAME=%s\n*ELASTIC\n%g, %g\n*DENSITY\n%g"):format(name,
      block.young[name], block.poisson, block.density)
    lines[#lines + 1] = ("*SOLID SECTION, ELSET=%s, MATERIAL=%s"):format(name, name)
  end
  lines[#lines + 1] = "*ELSET, ELSET=BLOCK\n" .. table.concat(names, ", ")
  return {lines = lines, nodes = nodes, elements = elements}
end

-- Adds a set of the nodes whose place satisfies a condition.
function deck.add_set(mesh, name, condition)
  local list = {}
  for number, x in ipairs(mesh.nodes) do
    if condition(table.unpack(x)) then list[#list + 1] = number end
  end
  mesh.lines[#mesh.lines + 1] = ("*NSET, NSET=%s\n%s"):format(name, table.concat(list, ",\n"))
end

-- Runs a deck in a folder and returns the lines of its results.
function deck.results(folder, name, lines)
  local job = folder .. "/" .. name
  local file = assert(io.open(job .. ".inp", "w"))
  file:write(table.concat(lines, "\n"), "\n")
  file:close()
  -- It leaves files where it runs.
  local run = ("cd '%s' && ccx '%s' > '%s.log'"):format(folder, name, name)
  assert(os.execute(run), "ccx failed; see " .. job .. ".log")
  return io.lines(job .. ".dat")
end

-- The lowest frequencies [Hz], without the first `skip`.
function deck.frequencies(folder, name, lines, skip, count)
  lines[#lines + 1] = ("*STEP\n*FREQUENCY\n%d\n*END STEP"):format(skip + count)
  local found = {}
  for line in deck.results(folder, name, lines) do
    local mode, hertz = line:match("^%s*(%d+)%s+%S+%s+%S+%s+(%S+)%s+%S+%s*$")
    if mode and tonumber(mode) > skip and #found < count then
      found[#found + 1] = tonumber(hertz)
    end
  end
  return found
end

return deck
