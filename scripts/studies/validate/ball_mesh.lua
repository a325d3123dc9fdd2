-- A mesh of a ball of diameter 1 m about the origin: a subdivided icosahedron, scaled so that it
-- has the volume of the ball.

local s = require "springlod"

local subdivisions = 5 -- the faces are within 0.02 % of the radius from the sphere
local g = (1 + math.sqrt(5)) / 2
local corners = {{-1, g, 0}, {1, g, 0}, {-1, -g, 0}, {1, -g, 0}, {0, -1, g}, {0, 1, g},
                 {0, -1, -g}, {0, 1, -g}, {g, 0, -1}, {g, 0, 1}, {-g, 0, -1}, {-g, 0, 1}}
local faces = {
  {1, 12, 6}, {1, 6, 2}, {1, 2, 8}, {1, 8, 11}, {1, 11, 12}, {2, 6, 10}, {6, 12, 5}, {12, 11, 3},
  {11, 8, 7}, {8, 2, 9}, {4, 10, 5}, {4, 5, 3}, {4, 3, 7}, {4, 7, 9}, {4, 9, 10}, {5, 10, 6},
  {3, 5, 12}, {7, 3, 11}, {9, 7, 8}, {10, 9, 2}}

local function unit(x, y, z)
  local length = math.sqrt(x * x + y * y + z * z)
  return {x / length, y / length, z / length}
end

-- Each triangle as four, with new vertices on the unit sphere.
local function subdivided(vertices, triangles)
  local middles, finer = {}, {}
  local function middle(i, j)
    local key = math.min(i, j) << 32 | math.max(i, j)
    if not middles[key] then
      local p, q = vertices[i], vertices[j]
      vertices[#vertices + 1] = unit(p[1] + q[1], p[2] + q[2], p[3] + q[3])
      middles[key] = #vertices
    end
    return middles[key]
  end
  for _, t in ipairs(triangles) do
    local a, b, c = middle(t[1], t[2]), middle(t[2], t[3]), middle(t[3], t[1])
    for _, part in ipairs{{t[1], a, c}, {t[2], b, a}, {t[3], c, b}, {a, b, c}} do
      finer[#finer + 1] = part
    end
  end
  return finer
end

local function volume(vertices, triangles)
  local sum = 0
  for _, t in ipairs(triangles) do
    local p, q, r = vertices[t[1]], vertices[t[2]], vertices[t[3]]
    sum = sum + p[1] * (q[2] * r[3] - q[3] * r[2]) + p[2] * (q[3] * r[1] - q[1] * r[3])
      + p[3] * (q[1] * r[2] - q[2] * r[1])
  end
  return sum / 6
end

local function obj_text()
  local vertices, triangles = {}, faces
  for i, corner in ipairs(corners) do vertices[i] = unit(table.unpack(corner)) end
  for _ = 1, subdivisions do triangles = subdivided(vertices, triangles) end
  local scale = (math.pi / 6 / volume(vertices, triangles)) ^ (1 / 3)
  local lines = {"o body"}
  for _, v in ipairs(vertices) do
    lines[#lines + 1] = ("v %.9f %.9f %.9f"):format(scale * v[1], scale * v[2], scale * v[3])
  end
  for _, t in ipairs(triangles) do
    lines[#lines + 1] = ("f %d %d %d"):format(t[1], t[2], t[3])
  end
  return table.concat(lines, "\n") .. "\n"
end

-- A mesh comes from a file only.
local function imported(text)
  local name = os.tmpname()
  local path = name .. ".obj"
  s.save_text(path, text)
  local mesh = s.import(path, {unit = "m", up = "z"})
  os.remove(path)
  os.remove(name)
  return mesh
end

local mesh -- made once

return function()
  mesh = mesh or imported(obj_text())
  return mesh
end
