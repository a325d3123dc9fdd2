-- Frequencies of a free block of two materials by CalculiX (Debian's package calculix-ccx), with
-- quadratic hexahedra: the references of scripts/studies/validate/two_materials.lua.
--   springlod --unsafe run tests/peers/calculix.lua [-- FOLDER]
local body = require "studies.validate.two_material_block"

local folder = arg[1] or "out/calculix"
local zero_modes, modes = 6, 10

-- Nodes of the element at (i, j, k), in steps of half a cell, in CalculiX's order.
local corners = {{0, 0, 0}, {2, 0, 0}, {2, 2, 0}, {0, 2, 0},
                 {0, 0, 2}, {2, 0, 2}, {2, 2, 2}, {0, 2, 2}}
local edges = {{1, 2}, {2, 3}, {3, 4}, {4, 1}, {5, 6}, {6, 7}, {7, 8}, {8, 5},
               {1, 5}, {2, 6}, {3, 7}, {4, 8}}
local places = {table.unpack(corners)}
for i, edge in ipairs(edges) do
  local a, b = corners[edge[1]], corners[edge[2]]
  places[8 + i] = {(a[1] + b[1]) // 2, (a[2] + b[2]) // 2, (a[3] + b[3]) // 2}
end

-- The deck of the block with `cells` cells per metre.
local function deck(cells, poisson)
  local size = {}
  for d = 1, 3 do size[d] = math.floor(body.size[d] * cells + 0.5) end
  local number_of, nodes, elements = {}, {}, {soft = {}, hard = {}}
  local function node(i, j, k)
    local key = ((i * (2 * size[2] + 1)) + j) * (2 * size[3] + 1) + k
    if not number_of[key] then
      number_of[key] = #nodes + 1
      nodes[#nodes + 1] = ("%d, %.12g, %.12g, %.12g"):format(#nodes + 1, i / 2 / cells,
        j / 2 / cells, k / 2 / cells)
    end
    return number_of[key]
  end
  local count = 0
  for k = 0, size[3] - 1 do
    for j = 0, size[2] - 1 do
      for i = 0, size[1] - 1 do
        count = count + 1
        local list = {count}
        for _, place in ipairs(places) do
          list[#list + 1] = node(2 * i + place[1], 2 * j + place[2], 2 * k + place[3])
        end
        local name = body.material_at((i + 0.5) / cells)
        -- Lines have at most 16 entries.
        table.insert(elements[name], table.concat(list, ", ", 1, 11) .. ",\n"
          .. table.concat(list, ", ", 12))
      end
    end
  end
  local lines = {"*NODE, NSET=ALL", table.concat(nodes, "\n")}
  for name, of_material in pairs(elements) do
    lines[#lines + 1] = ("*ELEMENT, TYPE=C3D20, ELSET=%s"):format(name)
    lines[#lines + 1] = table.concat(of_material, "\n")
    lines[#lines + 1] = ("*MATERIAL, NAME=%s\n*ELASTIC\n%g, %g\n*DENSITY\n%g"):format(name,
      body.young[name], poisson, body.density)
    lines[#lines + 1] = ("*SOLID SECTION, ELSET=%s, MATERIAL=%s"):format(name, name)
  end
  lines[#lines + 1] = ("*STEP\n*FREQUENCY\n%d\n*END STEP\n"):format(zero_modes + modes)
  return table.concat(lines, "\n")
end

local function frequencies(cells, poisson)
  local name = ("block_%d_%g"):format(cells, poisson)
  local job = folder .. "/" .. name
  local file = assert(io.open(job .. ".inp", "w"))
  file:write(deck(cells, poisson))
  file:close()
  -- It leaves files where it runs.
  local run = ("cd '%s' && ccx '%s' > '%s.log'"):format(folder, name, name)
  assert(os.execute(run), "ccx failed; see " .. job .. ".log")
  local found = {}
  for line in io.lines(job .. ".dat") do
    local mode, hertz = line:match("^%s*(%d+)%s+%S+%s+%S+%s+(%S+)%s+%S+%s*$")
    if mode and tonumber(mode) > zero_modes and #found < modes then
      found[#found + 1] = tonumber(hertz)
    end
  end
  return found
end

os.execute(("mkdir -p '%s'"):format(folder))
for _, poisson in ipairs(body.ratios) do
  for _, cells in ipairs{4, 8} do
    local list = frequencies(cells, poisson)
    for i, hertz in ipairs(list) do list[i] = ("%.5f"):format(hertz) end
    print(("nu = %g, %d cells per metre: %s"):format(poisson, cells, table.concat(list, ", ")))
  end
end
