-- Sums of quadratic energies 1/2 stiffness (sum of coefficients times displacements)^2, and what
-- follows from them. Three degrees of freedom per node, numbered node by node. A symmetric matrix
-- that belongs to such a sum has an energy.

local energies = {}

-- An energy of nodes, each with a vector of coefficients: list of {node, vector}. A node may occur
-- more than once.
function energies.energy(stiffness, parts)
  local at, by, place = {}, {}, {}
  for _, part in ipairs(parts) do
    for axis, value in ipairs(part[2]) do
      local freedom = 3 * (part[1] - 1) + axis
      if value ~= 0 and not place[freedom] then
        place[freedom] = #at + 1
        at[#at + 1], by[#by + 1] = freedom, 0
      end
      if value ~= 0 then by[place[freedom]] = by[place[freedom]] + value end
    end
  end
  return {stiffness = stiffness, at = at, by = by}
end

-- The stiffness matrix times u.
function energies.forces(list, u)
  local f = {}
  for i = 1, #u do f[i] = 0 end
  for _, one in ipairs(list) do
    local at, by, sum = one.at, one.by, 0
    for i = 1, #at do sum = sum + by[i] * u[at[i]] end
    sum = sum * one.stiffness
    for i = 1, #at do f[at[i]] = f[at[i]] + sum * by[i] end
  end
  return f
end

-- The lower half of the stiffness matrix: row i holds columns i - width to i. Rows and columns that
-- are fixed are those of the unit matrix.
local function assemble(list, count, fixed)
  local width, rows = 0, {}
  for _, one in ipairs(list) do
    local least, most = math.min(table.unpack(one.at)), math.max(table.unpack(one.at))
    width = math.max(width, most - least)
  end
  for i = 1, count do
    rows[i] = {}
    for k = 1, width do rows[i][k] = 0 end
    rows[i][width + 1] = fixed[i] and 1 or 0
  end
  for _, one in ipairs(list) do
    for p, i in ipairs(one.at) do
      for q, j in ipairs(one.at) do
        if j <= i and not fixed[i] and not fixed[j] then
          local k = j - i + width + 1
          rows[i][k] = rows[i][k] + one.stiffness * one.by[p] * one.by[q]
        end
      end
    end
  end
  return rows, width
end

-- Cholesky's factorization, in place. Returns the number of zero pivots. A row of a positive
-- semidefinite matrix whose pivot is zero is zero: its infinite root removes it.
local function factorize(rows, width)
  local zeros = 0
  for i, row in ipairs(rows) do
    local tolerance = 1e-10 * row[width + 1]
    for j = math.max(1, i - width), i do
      local other, shift = rows[j], i - j
      local sum = row[width + 1 - shift]
      for k = math.max(1, width + 2 - i), width - shift do
        sum = sum - row[k] * other[k + shift]
      end
      if j < i then
        row[width + 1 - shift] = sum / other[width + 1]
      else
        assert(sum >= -tolerance, ("the stiffness matrix has a negative eigenvalue"))
        if sum <= tolerance then zeros = zeros + 1 end
        row[width + 1] = sum <= tolerance and math.huge or math.sqrt(sum)
      end
    end
  end
  return zeros
end

-- How many independent displacements of `count` degrees of freedom have no energy.
function energies.zero_modes(list, count) return factorize(assemble(list, count, {})) end

-- Displacements of `count` degrees of freedom in equilibrium; force, fixed: tables by degree of
-- freedom. Nodes that interact should have close numbers.
function energies.equilibrium(list, count, force, fixed)
  local rows, width = assemble(list, count, fixed)
  assert(factorize(rows, width) == 0, "the body can move freely")
  local u = {}
  for i, row in ipairs(rows) do
    local sum = force[i] or 0
    for k = math.max(1, width + 2 - i), width do sum = sum - row[k] * u[i + k - width - 1] end
    u[i] = sum / row[width + 1]
  end
  for i = count, 1, -1 do
    local row = rows[i]
    u[i] = u[i] / row[width + 1]
    for k = math.max(1, width + 2 - i), width do
      local j = i + k - width - 1
      u[j] = u[j] - row[k] * u[i]
    end
  end
  return u
end

-- The largest eigenvalue, with the masses of the degrees of freedom, by power iteration.
function energies.largest_eigenvalue(list, masses, iterations)
  local x, value = {}, 0
  for i = 1, #masses do x[i] = math.sin(i * i) end -- has a part of each mode
  for _ = 1, iterations do
    local f, above, below = energies.forces(list, x), 0, 0
    for i, mass in ipairs(masses) do
      above, below = above + x[i] * f[i], below + mass * x[i] ^ 2
    end
    value = above / below
    for i, mass in ipairs(masses) do x[i] = f[i] / (mass * value * math.sqrt(below)) end
  end
  return value
end

return energies
