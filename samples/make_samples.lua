-- Makes the sample meshes of this folder:  springlod run samples/make_samples.lua -- [FOLDER]
-- Plain Lua 5.4. Every shape is defined by formulas.

local folder = arg and arg[1] or "samples"

-- A mesh: named parts of vertices {x, y, z} and triangles {i, j, k} counted from 1 in the part.
local function new_part(name, material)
  return {name = name, material = material, vertices = {}, triangles = {}}
end

local function write_obj(file, comment, unit, parts)
  local out = assert(io.open(folder .. "/" .. file, "w"))
  out:write("# ", comment, "\n# unit: ", unit, ", z up; made by samples/make_samples.lua\n")
  local first, count = 0, 0
  for _, part in ipairs(parts) do
    out:write("o ", part.name, "\nusemtl ", part.material, "\n")
    for _, v in ipairs(part.vertices) do
      out:write(("v %.5f %.5f %.5f\n"):format(v[1], v[2], v[3]))
    end
    for _, t in ipairs(part.triangles) do
      out:write(("f %d %d %d\n"):format(first + t[1], first + t[2], first + t[3]))
    end
    first, count = first + #part.vertices, count + #part.triangles
  end
  out:close()
  io.stderr:write(("%s/%s: %d triangles\n"):format(folder, file, count))
end

-- The dumbbell: rounded square bars along x -------------------------------------------------------

-- Outline of a square with round corners, counter-clockwise seen from +x, as {y, z} pairs.
local function rounded_square(half, radius)
  local outline, arc_steps, side_steps = {}, 5, 4
  for corner = 0, 3 do
    local middle = corner * math.pi / 2 + math.pi / 4
    local cy = (half - radius) * (math.cos(middle) > 0 and 1 or -1)
    local cz = (half - radius) * (math.sin(middle) > 0 and 1 or -1)
    for step = 0, arc_steps do
      local angle = corner * math.pi / 2 + step / arc_steps * math.pi / 2
      outline[#outline + 1] = {cy + radius * math.cos(angle), cz + radius * math.sin(angle)}
    end
    -- The straight side to the next corner, subdivided so that it can bend.
    local y, z = table.unpack(outline[#outline])
    local turn = (corner + 1) * math.pi / 2
    local length = 2 * (half - radius)
    for step = 1, side_steps - 1 do
      local s = length * step / side_steps
      outline[#outline + 1] = {y - math.sin(turn) * s, z + math.cos(turn) * s}
    end
  end
  return outline
end


-- Stations along a bar from x0 to x1 with ends rounded over `rim`: x, and the inset of the outline.
local function stations(x0, x1, rim)
  local list, rim_steps, step_length = {}, 4, 0.5
  for i = 0, rim_steps do
    local angle = i / rim_steps * math.pi / 2
    list[#list + 1] = {x0 + rim * (1 - math.cos(angle)), rim * (1 - math.sin(angle))}
  end
  local straight = x1 - x0 - 2 * rim
  local steps = math.floor(straight / step_length + 0.5)
  for i = 1, steps - 1 do list[#list + 1] = {x0 + rim + straight * i / steps, 0} end
  for i = rim_steps, 0, -1 do
    local angle = i / rim_steps * math.pi / 2
    list[#list + 1] = {x1 - rim * (1 - math.cos(angle)), rim * (1 - math.sin(angle))}
  end
  return list
end

local function bar(name, material, x0, x1, half, radius, rim)
  local part = new_part(name, material)
  local function vertex(x, y, z)
    part.vertices[#part.vertices + 1] = {x, y, z}
    return #part.vertices
  end
  local function triangle(i, j, k) part.triangles[#part.triangles + 1] = {i, j, k} end

  local rings, around = {}, 0
  for _, station in ipairs(stations(x0, x1, rim)) do
    local x, inset = station[1], station[2]
    local outline = rounded_square(half - inset, radius - inset)
    rings[#rings + 1], around = #part.vertices, #outline
    for _, p in ipairs(outline) do vertex(x, p[1], p[2]) end
  end
  for r = 1, #rings - 1 do
    local a, b = rings[r], rings[r + 1]
    for i = 1, around do
      local j = i % around + 1
      triangle(a + i, a + j, b + i)
      triangle(a + j, b + j, b + i)
    end
  end
  local first, last = rings[1], rings[#rings]
  local front, back = vertex(x0, 0, 0), vertex(x1, 0, 0)
  for i = 1, around do
    local j = i % around + 1
    triangle(front, first + j, first + i)
    triangle(back, last + i, last + j)
  end
  return part
end

local function dumbbell()
  -- 4 x 4 x 23 in all: with cells of 1 the lattice of the paper's second scene.
  return {
    bar("rod_left", "rod", -11.5, -2.5, 2, 1, 0.4),
    bar("joint", "rubber", -2.5, 2.5, 1.95, 0.8, 0.15),
    bar("rod_right", "rod", 2.5, 11.5, 2, 1, 0.4),
  }
end

-- The ball: two nested spheres --------------------------------------------------------------------

local function sphere(name, material, radius, subdivisions)
  local part = new_part(name, material)
  local function vertex(x, y, z)
    local s = radius / math.sqrt(x * x + y * y + z * z)
    part.vertices[#part.vertices + 1] = {x * s, y * s, z * s}
    return #part.vertices
  end
  local g = (1 + math.sqrt(5)) / 2
  for _, s in ipairs {{1, 1}, {-1, 1}, {1, -1}, {-1, -1}} do
    vertex(0, s[1], s[2] * g)
    vertex(s[1], s[2] * g, 0)
    vertex(s[2] * g, 0, s[1])
  end
  -- The 20 faces of the icosahedron: all triples of corners at edge length, oriented outwards.
  local corners = part.vertices
  local function distance(a, b)
    local p, q = corners[a], corners[b]
    return math.sqrt((p[1] - q[1]) ^ 2 + (p[2] - q[2]) ^ 2 + (p[3] - q[3]) ^ 2)
  end
  local edge = 2 * radius / math.sqrt(1 + g * g) * 1.001
  local function outwards(a, b, c)
    local p, q, r = corners[a], corners[b], corners[c]
    local det = p[1] * (q[2] * r[3] - q[3] * r[2]) - p[2] * (q[1] * r[3] - q[3] * r[1])
      + p[3] * (q[1] * r[2] - q[2] * r[1])
    return det > 0 and {a, b, c} or {a, c, b}
  end
  local faces = {}
  for a = 1, 12 do
    for b = a + 1, 12 do
      for c = b + 1, 12 do
        if distance(a, b) < edge and distance(b, c) < edge and distance(a, c) < edge then
          faces[#faces + 1] = outwards(a, b, c)
        end
      end
    end
  end
  for _ = 1, subdivisions do
    local middle, finer = {}, {}
    local function between(i, j)
      local key = math.min(i, j) .. " " .. math.max(i, j)
      if not middle[key] then
        local p, q = part.vertices[i], part.vertices[j]
        middle[key] = vertex(p[1] + q[1], p[2] + q[2], p[3] + q[3])
      end
      return middle[key]
    end
    for _, f in ipairs(faces) do
      local ab, bc, ca = between(f[1], f[2]), between(f[2], f[3]), between(f[3], f[1])
      finer[#finer + 1] = {f[1], ab, ca}
      finer[#finer + 1] = {f[2], bc, ab}
      finer[#finer + 1] = {f[3], ca, bc}
      finer[#finer + 1] = {ab, bc, ca}
    end
    faces = finer
  end
  part.triangles = faces
  return part
end

local function ball()
  return {sphere("core", "core", 2.3, 3), sphere("shell", "shell", 4.1, 4)}
end

-- The beast: a smooth union of limbs, meshed by surface nets (Gibson 1998) ------------------------

-- Limbs: cone-like capsules from p to q with radii rp and rq.
local limbs = {
  {-2.3, 0, 3.5, 2.0, 0, 3.7, 1.45, 1.6},     -- trunk
  {-2.6, 0, 3.6, -1.8, 0, 3.3, 1.5, 1.5},     -- haunches
  {2.3, 0, 4.1, 3.9, 0, 6.0, 1.15, 0.85},     -- neck
  {4.0, 0, 6.3, 4.3, 0, 6.3, 1.15, 1.1},      -- head
  {4.6, 0, 6.0, 5.7, 0, 5.6, 0.85, 0.6},      -- snout
  {3.6, 0.75, 7.0, 3.1, 1.25, 8.2, 0.42, 0.22}, -- ears
  {3.6, -0.75, 7.0, 3.1, -1.25, 8.2, 0.42, 0.22},
  {1.9, 0.95, 3.2, 2.1, 1.15, 0.7, 0.75, 0.55}, -- fore legs
  {1.9, -0.95, 3.2, 2.1, -1.15, 0.7, 0.75, 0.55},
  {-2.4, 1.0, 3.2, -2.2, 1.2, 0.7, 0.85, 0.55}, -- hind legs
  {-2.4, -1.0, 3.2, -2.2, -1.2, 0.7, 0.85, 0.55},
  {2.2, 1.15, 0.6, 2.6, 1.15, 0.55, 0.6, 0.55}, -- feet
  {2.2, -1.15, 0.6, 2.6, -1.15, 0.55, 0.6, 0.55},
  {-2.1, 1.2, 0.6, -1.7, 1.2, 0.55, 0.6, 0.55},
  {-2.1, -1.2, 0.6, -1.7, -1.2, 0.55, 0.6, 0.55},
  {-3.6, 0, 3.9, -4.9, 0, 4.6, 0.7, 0.5},     -- tail
  {-4.9, 0, 4.6, -5.5, 0, 5.9, 0.5, 0.38},
  {-5.5, 0, 5.9, -5.0, 0, 7.0, 0.38, 0.3},
}
local blend = 0.35 -- width over which limbs flow into one another

local function limb_distance(l, x, y, z)
  local dx, dy, dz = l[4] - l[1], l[5] - l[2], l[6] - l[3]
  local px, py, pz = x - l[1], y - l[2], z - l[3]
  local t = (px * dx + py * dy + pz * dz) / (dx * dx + dy * dy + dz * dz)
  t = math.max(0, math.min(1, t))
  local ex, ey, ez = px - t * dx, py - t * dy, pz - t * dz
  return math.sqrt(ex * ex + ey * ey + ez * ez) - (l[7] + t * (l[8] - l[7]))
end

local function field(x, y, z)
  local sum = 0
  for i = 1, #limbs do sum = sum + math.exp(-limb_distance(limbs[i], x, y, z) / blend) end
  return -blend * math.log(sum)
end

local function gradient(x, y, z)
  local h = 1e-4
  return (field(x + h, y, z) - field(x - h, y, z)) / (2 * h),
    (field(x, y + h, z) - field(x, y - h, z)) / (2 * h),
    (field(x, y, z + h) - field(x, y, z - h)) / (2 * h)
end

local function beast()
  local part = new_part("beast", "flesh")
  local step = 0.16
  local low, n = {-6.6, -2.6, -0.6}, {0, 0, 0}
  for axis, high in ipairs {7.0, 2.6, 9.2} do
    n[axis] = math.ceil((high - low[axis]) / step)
  end
  local function point(i, j, k) return low[1] + i * step, low[2] + j * step, low[3] + k * step end
  local stride_y, stride_z = n[1] + 1, (n[1] + 1) * (n[2] + 1)
  local value = {}
  for k = 0, n[3] do
    for j = 0, n[2] do
      for i = 0, n[1] do value[i + stride_y * j + stride_z * k] = field(point(i, j, k)) end
    end
  end
  local function inside(i, j, k) return value[i + stride_y * j + stride_z * k] < 0 end

  -- One vertex in each cell that the surface crosses, projected onto the surface along the
  -- gradient.
  local number = {}
  local function cell_vertex(i, j, k)
    local key = i + stride_y * j + stride_z * k
    if number[key] then return number[key] end
    local x, y, z, crossings = 0, 0, 0, 0
    local function edge(i0, j0, k0, di, dj, dk)
      local a = value[i0 + stride_y * j0 + stride_z * k0]
      local b = value[i0 + di + stride_y * (j0 + dj) + stride_z * (k0 + dk)]
      if (a < 0) == (b < 0) then return end
      local t = a / (a - b)
      local px, py, pz = point(i0 + t * di, j0 + t * dj, k0 + t * dk)
      x, y, z, crossings = x + px, y + py, z + pz, crossings + 1
    end
    for u = 0, 1 do
      for v = 0, 1 do
        edge(i, j + u, k + v, 1, 0, 0)
        edge(i + u, j, k + v, 0, 1, 0)
        edge(i + u, j + v, k, 0, 0, 1)
      end
    end
    x, y, z = x / crossings, y / crossings, z / crossings
    for _ = 1, 3 do
      local gx, gy, gz = gradient(x, y, z)
      local s = field(x, y, z) / (gx * gx + gy * gy + gz * gz)
      x, y, z = x - s * gx, y - s * gy, z - s * gz
    end
    part.vertices[#part.vertices + 1] = {x, y, z}
    number[key] = #part.vertices
    return #part.vertices
  end
  local function quad(a, b, c, d, forward)
    if not forward then b, d = d, b end
    part.triangles[#part.triangles + 1] = {a, b, c}
    part.triangles[#part.triangles + 1] = {a, c, d}
  end
  for k = 1, n[3] - 1 do
    for j = 1, n[2] - 1 do
      for i = 1, n[1] - 1 do
        local here = inside(i, j, k)
        if here ~= inside(i + 1, j, k) then
          quad(cell_vertex(i, j - 1, k - 1), cell_vertex(i, j, k - 1), cell_vertex(i, j, k),
            cell_vertex(i, j - 1, k), here)
        end
        if here ~= inside(i, j + 1, k) then
          quad(cell_vertex(i - 1, j, k - 1), cell_vertex(i - 1, j, k), cell_vertex(i, j, k),
            cell_vertex(i, j, k - 1), here)
        end
        if here ~= inside(i, j, k + 1) then
          quad(cell_vertex(i - 1, j - 1, k), cell_vertex(i, j - 1, k), cell_vertex(i, j, k),
            cell_vertex(i - 1, j, k), here)
        end
      end
    end
  end
  return {part}
end

write_obj("dumbbell.obj", "two stiff rods and a rubber joint", "dm", dumbbell())
write_obj("ball.obj", "dense core in a soft shell", "dm", ball())
write_obj("beast.obj", "an organic closed shape", "cm", beast())
