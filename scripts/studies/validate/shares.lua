-- Identifies modes by the part of them that lies in the span of given vector fields.

local shares = {}

local function product(a, b, masses)
  local sum = 0
  for i, m in ipairs(masses) do
    local u, v = a[i], b[i]
    sum = sum + m * (u[1] * v[1] + u[2] * v[2] + u[3] * v[3])
  end
  return sum
end

local function add(a, factor, b)
  for i, v in ipairs(b) do
    local u = a[i]
    for d = 1, 3 do u[d] = u[d] + factor * v[d] end
  end
end

-- Fields with less of their norm than this left, squared, depend on the fields before [1].
local dependent = 1e-12

-- An orthonormal basis of the span of `fields`, functions of x, y and z that return a vector, on
-- the nodes of a model. Weighted with the masses, as modes are.
function shares.basis(model, fields)
  local nodes, masses, basis = model:nodes(), {}, {}
  for i, node in ipairs(nodes) do masses[i] = node.mass end
  for _, field in ipairs(fields) do
    local values = {}
    for i, node in ipairs(nodes) do values[i] = {field(node.x, node.y, node.z)} end
    local whole = product(values, values, masses)
    for _, before in ipairs(basis) do add(values, -product(values, before, masses), before) end
    local square = product(values, values, masses)
    if square > dependent * whole then
      for _, v in ipairs(values) do for d = 1, 3 do v[d] = v[d] / math.sqrt(square) end end
      basis[#basis + 1] = values
    end
  end
  return {fields = basis, masses = masses}
end

-- The part of a mode in the span of a basis, 0 to 1.
function shares.of(mode, basis)
  local sum = 0
  for _, field in ipairs(basis.fields) do
    sum = sum + product(mode.shape, field, basis.masses) ^ 2
  end
  return sum
end

-- The mean frequency [Hz] of the lowest `count` modes that lie mainly in the span of the fields;
-- nil if there are fewer.
function shares.frequency(model, modes, fields, count)
  local mainly = 0.5
  local basis, sum, found = shares.basis(model, fields), 0, 0
  for _, mode in ipairs(modes) do
    if found < count and shares.of(mode, basis) > mainly then
      sum, found = sum + mode.frequency, found + 1
    end
  end
  return found == count and sum / count or nil
end

return shares
