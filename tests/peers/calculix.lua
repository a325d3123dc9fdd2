-- Blocks of quadratic hexahedra in CalculiX (Debian's package calculix-ccx): the references of
-- scripts/studies/validate/two_materials.lua and plates.lua.
--   springlod --unsafe run tests/peers/calculix.lua [-- FOLDER]
local two_materials = require "studies.validate.two_material_block"
local pad = require "studies.validate.pad"

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

-- The model of a block with `cells` cells per metre, as lines of a deck, and the numbers of the
-- nodes of its lowest and its highest layer. block: size [m], young (material -> [Pa]), poisson,
-- density, material_at(x).
local function mesh(block, cells)
  local size = {}
  for d = 1, 3 do size[d] = math.floor(block.size[d] * cells + 0.5) end
  local number_of, nodes, elements, low, high = {}, {}, {}, {}, {}
  for name in pairs(block.young) do elements[name] = {} end
  local function node(i, j, k)
    local key = ((i * (2 * size[2] + 1)) + j) * (2 * size[3] + 1) + k
    if not number_of[key] then
      number_of[key] = #nodes + 1
      nodes[#nodes + 1] = ("%d, %.12g, %.12g, %.12g"):format(#nodes + 1, i / 2 / cells,
        j / 2 / cells, k / 2 / cells)
      if k == 0 then low[#low + 1] = #nodes end
      if k == 2 * size[3] then high[#high + 1] = #nodes end
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
        local name = block.material_at((i + 0.5) / cells)
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
      block.young[name], block.poisson, block.density)
    lines[#lines + 1] = ("*SOLID SECTION, ELSET=%s, MATERIAL=%s"):format(name, name)
  end
  return lines, low, high
end

-- Runs a deck and returns the lines of its results.
local function results(name, lines)
  local job = folder .. "/" .. name
  local file = assert(io.open(job .. ".inp", "w"))
  file:write(table.concat(lines, "\n"), "\n")
  file:close()
  -- It leaves files where it runs.
  local run = ("cd '%s' && ccx '%s' > '%s.log'"):format(folder, name, name)
  assert(os.execute(run), "ccx failed; see " .. job .. ".log")
  return io.lines(job .. ".dat")
end

local function frequencies(cells, poisson)
  local block = {size = two_materials.size, young = two_materials.young, poisson = poisson,
                 density = two_materials.density, material_at = two_materials.material_at}
  local lines = mesh(block, cells)
  lines[#lines + 1] = ("*STEP\n*FREQUENCY\n%d\n*END STEP"):format(zero_modes + modes)
  local found = {}
  for line in results(("block_%d_%g"):format(cells, poisson), lines) do
    local mode, hertz = line:match("^%s*(%d+)%s+%S+%s+%S+%s+(%S+)%s+%S+%s*$")
    if mode and tonumber(mode) > zero_modes and #found < modes then
      found[#found + 1] = tonumber(hertz)
    end
  end
  return found
end

-- The force that presses the pad, over young * strain * area.
local function pressed(cells, poisson)
  local block = {size = pad.size, young = {pad = pad.young}, poisson = poisson, density = 1,
                 material_at = function() return "pad" end}
  local lines, low, high = mesh(block, cells)
  local function add(format, ...) lines[#lines + 1] = format:format(...) end
  add("*NSET, NSET=LOW\n%s", table.concat(low, ",\n"))
  add("*NSET, NSET=HIGH\n%s", table.concat(high, ",\n"))
  add("*BOUNDARY\nLOW, 1, 3\nHIGH, 1, 2\nHIGH, 3, 3, %g", -pad.press * pad.size[3])
  table.insert(lines, #lines, "*STEP\n*STATIC")
  add("*NODE PRINT, NSET=HIGH, TOTALS=ONLY\nRF\n*END STEP")
  for line in results(("pad_%d_%g"):format(cells, poisson), lines) do
    local force = line:match("^%s*%S+E%S+%s+%S+E%S+%s+(%S+E%S+)%s*$")
    if force then
      return -tonumber(force) / (pad.young * pad.press * pad.size[1] * pad.size[2])
    end
  end
end

os.execute(("mkdir -p '%s'"):format(folder))
for _, poisson in ipairs(two_materials.ratios) do
  for _, cells in ipairs{4, 8} do
    local list = frequencies(cells, poisson)
    for i, hertz in ipairs(list) do list[i] = ("%.5f"):format(hertz) end
    print(("two materials, nu = %g, %d cells per metre: %s"):format(poisson, cells,
      table.concat(list, ", ")))
  end
end
for _, poisson in ipairs(pad.ratios) do
  for _, cells in ipairs{8, 16, 24} do
    print(("plates, nu = %g, %d cells per metre: %.5f"):format(poisson, cells,
      pressed(cells, poisson)))
  end
end
