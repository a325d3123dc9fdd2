-- Compare three ways to give mass-spring lattices any Poisson's ratio.

local s = require "springlod"
local cantilever = require "lib.cantilever"
local command = require "lib.command"
local energies = require "studies.poisson_ways.energies"
local markdown = require "lib.markdown"
local ways = require "studies.poisson_ways.ways"

local parser = command.parser("poisson_ways", "Compare three ways to give a lattice any Poisson's "
  .. "ratio, in small displacements: springlod's cell terms; these with cube diagonals, of Golec "
  .. "et al. (2020); node terms, after Kot and Nagahashi (2015). Prints Markdown tables: a "
  .. "stretched bar, zero modes, the tip of a cantilever, the stable step.")
command.add_out(parser, "out/poisson_ways.csv", "file")
command.renamed(parser, "--csv", "--out")
parser:flag("--quick", "two ratios, two cells across; takes seconds")
local args = parser:parse()

local ratios = args.quick and {0.25, 0.45} or {0, 0.1, 0.25, 0.3, 0.4, 0.45, 0.49}
local across = args.quick and {2} or {2, 4} -- cells across the cantilever
local bar = {6, 3, 3} -- cells of what is stretched, also for the zero modes
-- For the largest eigenvalue; within 0.1 % of s.stable_step.
local block, iterations = args.quick and {3, 3, 3} or {6, 6, 6}, args.quick and 100 or 300

-- Adds a cell of a lattice to its springs: each pair of corners, which differ in 1 to 3 axes.
local function add_pairs(lattice, places, cell)
  for p = 1, 8 do
    for q = p + 1, 8 do
      local key = cell[p] .. " " .. cell[q]
      if not places[key] then
        local spring = {a = cell[p], b = cell[q], along = {}, axes = 0, cells = 0}
        for axis = 1, 3 do
          spring.along[axis] = (q - 1 >> axis - 1 & 1) - (p - 1 >> axis - 1 & 1)
          spring.axes = spring.axes + spring.along[axis] ^ 2 // 1 | 0
        end
        places[key] = spring
        table.insert(lattice.springs, spring)
      end
      places[key].cells = places[key].cells + 1
    end
  end
end

-- Nodes at the corners of a block of cells, layer by layer along x; each cell has mass 1.
local function lattice_of(size)
  local lattice, places = {masses = {}, positions = {}, springs = {}, cells = {}}, {}
  local function number(x, y, z) return (x * (size[2] + 1) + y) * (size[3] + 1) + z + 1 end
  local function each(extra, visit)
    for x = 0, size[1] - 1 + extra do
      for y = 0, size[2] - 1 + extra do
        for z = 0, size[3] - 1 + extra do visit(x, y, z) end
      end
    end
  end
  each(1, function(x, y, z)
    lattice.positions[number(x, y, z)] = {x, y, z}
    lattice.masses[number(x, y, z)] = 0
  end)
  each(0, function(x, y, z)
    local cell = {}
    for corner = 0, 7 do
      local node = number(x + (corner & 1), y + (corner >> 1 & 1), z + (corner >> 2))
      cell[corner + 1] = node
      lattice.masses[node] = lattice.masses[node] + 1 / 8
    end
    table.insert(lattice.cells, cell)
    add_pairs(lattice, places, cell)
  end)
  return lattice
end

-- A load of 1 along an axis on the end faces of a block: +1 on the last layer of nodes, and `first`
-- on the first layer, in proportion to the area of each node.
local function end_load(lattice, size, axis, first)
  local force = {}
  for node, position in ipairs(lattice.positions) do
    local area = 2 * lattice.masses[node] / (size[2] * size[3])
    if position[1] == size[1] then force[3 * (node - 1) + axis] = area end
    if position[1] == 0 then force[3 * (node - 1) + axis] = first * area end
  end
  return force
end

-- Young's modulus and Poisson's ratio: slopes of the displacements of a stretched bar, by least
-- squares along x and across it.
local function stretch(way, poisson)
  local lattice = lattice_of(bar)
  local fixed = {true, true, true, [5] = true} -- node 1, and turns of it about x, y and z
  local beside = bar[3] + 2 -- the neighbour of node 1 along y
  fixed[3 * beside - 2], fixed[4] = true, true
  local u = energies.equilibrium(way.make(lattice, poisson), 3 * #lattice.masses,
    end_load(lattice, bar, 1, -1), fixed)
  local slope = {}
  for axis = 1, 3 do
    local above, below = 0, 0
    for node, position in ipairs(lattice.positions) do
      above = above + position[axis] * u[3 * (node - 1) + axis]
      below = below + position[axis] ^ 2
    end
    slope[axis] = above / below
  end
  return 1 / (bar[2] * bar[3] * slope[1]), -(slope[2] + slope[3]) / (2 * slope[1])
end

-- The deflection of the loaded end of a cantilever over that of Timoshenko's beam.
local function tip(way, cells, poisson)
  local size = {cantilever.slenderness * cells, cells, cells}
  local lattice, fixed = lattice_of(size), {}
  for freedom = 1, 3 * (cells + 1) ^ 2 // 1 do fixed[freedom] = true end
  local force = end_load(lattice, size, 3, 0)
  local u = energies.equilibrium(way.make(lattice, poisson), 3 * #lattice.masses, force, fixed)
  local deflection = 0
  for freedom, share in pairs(force) do deflection = deflection + share * u[freedom] end
  local unit = 1 / (cantilever.young * cantilever.height)
  return deflection * cells * unit / cantilever.timoshenko(poisson)[1]
end

local function measure(way, poisson)
  local lattice, masses, row = lattice_of(block), {}, {poisson = poisson, tips = {}}
  for node, mass in ipairs(lattice.masses) do
    for axis = 1, 3 do masses[3 * (node - 1) + axis] = mass end
  end
  row.eigenvalue = energies.largest_eigenvalue(way.make(lattice, poisson), masses, iterations)
  local free = lattice_of(bar)
  row.zero_modes = energies.zero_modes(way.make(free, poisson), 3 * #free.masses)
  local young, ratio = stretch(way, poisson)
  row.young, row.ratio = young - 1, ratio - poisson
  for i, cells in ipairs(across) do row.tips[i] = tip(way, cells, poisson) - 1 end
  s.say(("%s: Poisson's ratio %g"):format(way.name, poisson))
  return row
end

-- Largest differences of tips and steps of the program's own models from those of the first way.
local function differences(rows)
  local tips, steps = 0, 0
  for _, row in ipairs(rows) do
    local expected = cantilever.timoshenko(row.poisson)[1]
    for i, cells in ipairs(across) do
      local model, force = cantilever.model({}, cells, row.poisson), {}
      for node, share in pairs(cantilever.end_face(model, cells)) do force[node] = {0, 0, share} end
      local bent = s.deflect(model, {anchored = cantilever.clamped(cells), force = force})
      tips = math.max(tips, math.abs(bent.compliance / expected - 1 - row.tips[i]))
    end
    local own = s.stable_step(s.lattice(s.grid{
      cell = 1, size = block, fill = function() return "block" end,
      materials = {block = {young = 1, density = 1, damping = 0, poisson = row.poisson}}}))
    steps = math.max(steps, math.abs(own * math.sqrt(row.eigenvalue) / 2 - 1))
  end
  return tips, steps
end

-- Adds steps over those of springs alone, which all ratios 1/4 of the first way have.
local function add_steps(rows)
  local usual
  for i, poisson in ipairs(ratios) do
    if poisson == 0.25 then usual = rows[1][i].eigenvalue end
  end
  for _, of_way in ipairs(rows) do
    for _, row in ipairs(of_way) do row.step = math.sqrt(usual / row.eigenvalue) end
  end
end

local function by_ratio(rows)
  local columns, texts = {"nu"}, {}
  for i, poisson in ipairs(ratios) do texts[i] = {("%g"):format(poisson)} end
  local function add(name, text)
    for number, way in ipairs(ways) do
      columns[#columns + 1] = ("%s, %s"):format(name, way.name)
      for i, row in ipairs(rows[number]) do table.insert(texts[i], text(row)) end
    end
  end
  for k, cells in ipairs(across) do
    add(("tip, %d cells"):format(cells), function(row)
      return ("%+.1f %%"):format(100 * row.tips[k])
    end)
  end
  add("step", function(row) return ("%.2f"):format(row.step) end)
  return markdown.table(texts, columns)
end

local function largest(rows, name)
  local most = 0
  for _, row in ipairs(rows) do most = math.max(most, math.abs(row[name])) end
  return most
end

local function by_way(rows)
  local texts = {}
  for number, way in ipairs(ways) do
    local of_way = rows[number]
    texts[number] = {way.name, ("%.0e"):format(largest(of_way, "young")),
                     ("%.0e"):format(largest(of_way, "ratio")), largest(of_way, "zero_modes"),
                     way.springs, way.nodes}
  end
  return markdown.table(texts, {"way", "error of E", "error of nu", "zero modes",
    "springs per cell", "nodes per term"})
end

local function write(path, rows)
  local columns, values = {"way", "nu", "E error", "nu error", "step", "zero modes"}, {}
  for _, cells in ipairs(across) do
    columns[#columns + 1] = ("tip error, %d cells"):format(cells)
  end
  for number, way in ipairs(ways) do
    for _, row in ipairs(rows[number]) do
      values[#values + 1] = {way.name, row.poisson, row.young, row.ratio, row.step,
                             row.zero_modes, table.unpack(row.tips)}
    end
  end
  s.csv(path, values, {columns = columns})
end

local ok, failure = command.try(function()
  local rows = {}
  for number, way in ipairs(ways) do
    rows[number] = {}
    for i, poisson in ipairs(ratios) do rows[number][i] = measure(way, poisson) end
  end
  add_steps(rows)
  print(by_way(rows) .. "\n\n" .. by_ratio(rows) .. "\n")
  print(("The program's own models differ from cell terms by %.0e (tips) and %.0e (steps)."):format(
    differences(rows[1])))
  write(args.out, rows)
end)
if not ok then command.fail("poisson_ways: %s", failure) end
