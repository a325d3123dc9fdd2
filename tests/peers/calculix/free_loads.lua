-- Compliances of a free block under forces per volume, which inertia balances. The block and the
-- size of the forces are symmetric about its middle planes across y and z, so a quarter is enough.

local deck = require "calculix.deck"
local vectors = require "lib.vectors"

local free_loads = {}

-- Gauss's rule on [0, 1], {place, weight}. With two points it is exact for forces of degree 2 times
-- trilinear shape functions, with three for those times quadratic ones.
local far, near = math.sqrt(0.6) / 2, math.sqrt(1 / 3) / 2
local rules = {
  C3D8 = {{0.5 - near, 1 / 2}, {0.5 + near, 1 / 2}},
  C3D20 = {{0.5 - far, 5 / 18}, {0.5, 4 / 9}, {0.5 + far, 5 / 18}},
}

-- Shape functions of an element at a place in [-1, 1]^3.
local function shapes(kind, xi)
  local values = {}
  for n, place in ipairs(deck.places[kind]) do
    local product, sum, middle = 1, 0, false
    for d = 1, 3 do
      local at = place[d] - 1
      if at == 0 then
        product, middle = product * (1 - xi[d] ^ 2), true
      else
        product, sum = product * (1 + at * xi[d]), sum + at * xi[d]
      end
    end
    if middle then
      values[n] = product / 4
    else
      values[n] = product / 8 * (kind == "C3D20" and sum - 2 or 1)
    end
  end
  return values
end

-- Points of an element of edge 1: {x, y, z, weight = , shapes = of its nodes}.
local function points_of(kind)
  local points = {}
  for _, a in ipairs(rules[kind]) do
    for _, b in ipairs(rules[kind]) do
      for _, c in ipairs(rules[kind]) do
        points[#points + 1] = {
          a[1], b[1], c[1], weight = a[2] * b[2] * c[2],
          shapes = shapes(kind, {2 * a[1] - 1, 2 * b[1] - 1, 2 * c[1] - 1}),
        }
      end
    end
  end
  return points
end

-- The field minus the forces of inertia of the rigid motion that it causes in a box of uniform
-- density, as a function of a place relative to its centre.
local function balanced(size, field)
  local volume = size[1] * size[2] * size[3]
  local force, torque = {0, 0, 0}, {0, 0, 0}
  for _, point in ipairs(points_of("C3D20")) do -- the whole box as one element
    local r, weight = {}, point.weight * volume
    for d = 1, 3 do r[d] = (point[d] - 0.5) * size[d] end
    local f = field(table.unpack(r))
    local moment = vectors.cross(r, f)
    for d = 1, 3 do
      force[d], torque[d] = force[d] + weight * f[d], torque[d] + weight * moment[d]
    end
  end
  local turning = {} -- angular acceleration times density
  for d = 1, 3 do
    local squares = size[1] ^ 2 + size[2] ^ 2 + size[3] ^ 2 - size[d] ^ 2
    turning[d] = torque[d] / (volume * squares / 12)
  end
  return function(r)
    local f, turned = field(table.unpack(r)), vectors.cross(turning, r)
    for d = 1, 3 do f[d] = f[d] - force[d] / volume - turned[d] end
    return f
  end
end

-- Forces on the nodes of a quarter that do the same work as a field, as lines of a deck.
local function consistent(block, cells, mesh, points, field)
  local sums = {}
  for number in ipairs(mesh.nodes) do sums[number] = {0, 0, 0} end
  for _, element in ipairs(mesh.elements) do
    for _, point in ipairs(points) do
      local r = {}
      for d = 1, 3 do r[d] = element[d] + point[d] / cells end
      r[1] = r[1] - block.size[1] / 2
      local f, weight = field(r), point.weight / cells ^ 3
      for n, number in ipairs(element.nodes) do
        local sum, share = sums[number], weight * point.shapes[n]
        for d = 1, 3 do sum[d] = sum[d] + share * f[d] end
      end
    end
  end
  local lines = {}
  for number, sum in ipairs(sums) do
    for d = 1, 3 do lines[#lines + 1] = ("%d, %d, %.12g"):format(number, d, sum[d]) end
  end
  return table.concat(lines, "\n")
end

-- Whether a field is its own mirror image in the plane across axis d; if not, it is the opposite.
local function symmetric(field, d)
  local r, image, product = {0.1, 0.2, 0.3}, {0.1, 0.2, 0.3}, 0
  image[d] = -image[d]
  local f, other = field(r), field(image)
  other[d] = -other[d]
  for e = 1, 3 do product = product + f[e] * other[e] end
  return product > 0
end

-- What holds the nodes of the middle planes, and of the rigid motions that these leave.
local function supports(field)
  local over_y, over_z = symmetric(field, 2), symmetric(field, 3)
  local lines = {"*BOUNDARY, OP=NEW"}
  local function add(line) lines[#lines + 1] = line end
  add(over_y and "MIDDLE_Y, 2, 2" or "MIDDLE_Y, 1, 1\nMIDDLE_Y, 3, 3")
  add(over_z and "MIDDLE_Z, 3, 3" or "MIDDLE_Z, 1, 2")
  if over_y and over_z then
    add("START, 1, 1")
  elseif over_z then
    add("START, 2, 2\nEND, 2, 2")
  elseif over_y then
    add("START, 3, 3\nEND, 3, 3")
  else
    add("TOP, 2, 2")
  end
  return table.concat(lines, "\n")
end

-- The quarter y > 0, z > 0 of a block, as a deck with the sets that are held.
local function quarter(block, cells)
  local length, _, height = table.unpack(block.size)
  local mesh = deck.mesh({
    size = {length, block.size[2] / 2, height / 2}, young = block.young, poisson = block.poisson,
    density = block.density, material_at = block.material_at, kind = block.kind}, cells)
  deck.add_set(mesh, "MIDDLE_Y", function(_, y) return y == 0 end)
  deck.add_set(mesh, "MIDDLE_Z", function(_, _, z) return z == 0 end)
  deck.add_set(mesh, "START", function(x, y, z) return x == 0 and y == 0 and z == 0 end)
  deck.add_set(mesh, "END", function(x, y, z) return x == length and y == 0 and z == 0 end)
  deck.add_set(mesh, "TOP", function(x, y, z) return x == 0 and y == 0 and z == height / 2 end)
  return mesh
end

-- Work of each of a list of fields [N/m3] on the displacements that it causes [J], in a block whose
-- centre is its centre of mass.
function free_loads.compliances(folder, name, block, cells, fields)
  local mesh, points = quarter(block, cells), points_of(block.kind)
  local lines = mesh.lines
  for _, field in ipairs(fields) do
    local in_balance = balanced(block.size, field)
    lines[#lines + 1] = "*STEP\n*STATIC"
    lines[#lines + 1] = supports(in_balance)
    lines[#lines + 1] = "*CLOAD, OP=NEW"
    lines[#lines + 1] = consistent(block, cells, mesh, points, in_balance)
    lines[#lines + 1] = "*EL PRINT, ELSET=BLOCK, TOTALS=ONLY\nELSE\n*END STEP"
  end
  local found = {}
  for line in deck.results(folder, name, lines) do
    local energy = line:match("^%s*(%d%S*E%S+)%s*$") -- of the quarter: half the work
    if energy then found[#found + 1] = 4 * 2 * tonumber(energy) end
  end
  assert(#found == #fields, "one energy for each load")
  return found
end

return free_loads
