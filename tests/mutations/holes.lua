-- Remove faces from closed meshes, and compare the volume of the cells with that of the whole mesh:
--   springlod run tests/mutations/holes.lua -- SEEDS [FILE.obj...]
-- Takes 0.1, 1 and 5 % of the faces from the files (default: all samples) and from some hollow
-- bodies of its own, with SEEDS random choices for each. Prints a row for each mesh and fraction.
-- Exit code 1 if fewer than 95 % of all meshes have the volume of the whole one within 2 %.

local s = require "springlod"

local seeds = math.tointeger(tonumber((...))) or error("give the number of seeds")
local files = {select(2, ...)}
if #files == 0 then files = s.files("samples", {endings = {".obj"}}) end
local fractions = {0.001, 0.01, 0.05}
local tolerance, goal = 0.02, 0.95

-- The lines of an OBJ file.
local function read(path)
  local lines = {}
  for line in io.lines(path) do lines[#lines + 1] = line end
  return lines
end

-- Adds a surface to the lines of an OBJ file: a grid of `rings` x `sectors` points, closed in both
-- directions, whose faces are on the left of ring and sector.
local function add_ring_surface(lines, rings, sectors, point)
  local first = 1
  for _, line in ipairs(lines) do if line:find("^v ") then first = first + 1 end end
  for ring = 0, rings - 1 do
    for sector = 0, sectors - 1 do
      lines[#lines + 1] = ("v %.9g %.9g %.9g"):format(point(ring / rings, sector / sectors))
    end
  end
  local function at(ring, sector) return first + ring % rings * sectors + sector % sectors end
  for ring = 0, rings - 1 do
    for sector = 0, sectors - 1 do
      local a, b = at(ring, sector), at(ring + 1, sector)
      local c, d = at(ring + 1, sector + 1), at(ring, sector + 1)
      lines[#lines + 1] = ("f %d %d %d"):format(a, b, c)
      lines[#lines + 1] = ("f %d %d %d"):format(a, c, d)
    end
  end
end

-- A torus whose tube has the given radius; a negative one turns it inside out.
local function add_torus(lines, tube)
  add_ring_surface(lines, 48, 24, function(around, across)
    local phi, theta = 2 * math.pi * around, 2 * math.pi * across * (tube < 0 and -1 or 1)
    local radius = 1 + math.abs(tube) * math.cos(theta)
    return radius * math.cos(phi), radius * math.sin(phi), math.abs(tube) * math.sin(theta)
  end)
end

-- The faces of a cube of that edge; a negative one turns it inside out.
local function add_cube(lines, edge)
  local first, n, half = 1, 12, edge / 2
  for _, line in ipairs(lines) do if line:find("^v ") then first = first + 1 end end
  local numbers, count = {}, 0
  local function vertex(x, y, z)
    local key = ("%d %d %d"):format(x, y, z)
    if not numbers[key] then
      local function place(steps) return half * (2 * steps / n - 1) end
      lines[#lines + 1] = ("v %.9g %.9g %.9g"):format(place(x), place(y), place(z))
      numbers[key], count = first + count, count + 1
    end
    return numbers[key]
  end
  for axis = 0, 2 do
    for side = 0, n, n do
      for u = 0, n - 1 do
        for v = 0, n - 1 do
          local function corner(du, dv)
            local at = {side, u + du, v + dv}
            return vertex(at[(3 - axis) % 3 + 1], at[(4 - axis) % 3 + 1], at[(5 - axis) % 3 + 1])
          end
          local a, b, c, d = corner(0, 0), corner(1, 0), corner(1, 1), corner(0, 1)
          if side == 0 then b, d = d, b end
          lines[#lines + 1] = ("f %d %d %d %d"):format(a, b, c, d)
        end
      end
    end
  end
end

-- The meshes by name, as lines of OBJ files.
local function meshes()
  local list = {}
  for _, path in ipairs(files) do list[#list + 1] = {name = path, lines = read(path)} end
  local made = {
    {name = "torus", add = function(lines) add_torus(lines, 0.4) end},
    {name = "hollow torus", add = function(lines)
      add_torus(lines, 0.4)
      add_torus(lines, -0.25)
    end},
    {name = "hollow cube", add = function(lines)
      add_cube(lines, 1)
      add_cube(lines, -0.6)
    end},
  }
  for _, mesh in ipairs(made) do
    mesh.lines = {"o " .. mesh.name:gsub(" ", "_")}
    mesh.add(mesh.lines)
    list[#list + 1] = mesh
  end
  return list
end

local path = os.tmpname()
os.remove(path)
path = path .. ".obj"

-- The volume of the cells of a mesh, or nil and the reason.
local function volume_of(lines)
  local file = assert(io.open(path, "wb"))
  assert(file:write(table.concat(lines, "\n"), "\n"))
  assert(file:close())
  local ok, result = pcall(function()
    return s.voxelize(s.import(path, {unit = "m", up = "z"})).volume
  end)
  os.remove(path)
  if ok then return result end
  return nil, tostring(result)
end

-- The lines without `fraction` of the faces, at least one.
local function without_faces(lines, fraction)
  local faces = {}
  for i, line in ipairs(lines) do if line:find("^f ") then faces[#faces + 1] = i end end
  local removed = {}
  for i = 1, math.max(1, math.floor(fraction * #faces + 0.5)) do
    local other = math.random(i, #faces)
    faces[i], faces[other] = faces[other], faces[i]
    removed[faces[i]] = true
  end
  local kept = {}
  for i, line in ipairs(lines) do if not removed[i] then kept[#kept + 1] = line end end
  return kept
end

local rows, total, within = {}, 0, 0
for _, mesh in ipairs(meshes()) do
  local whole = assert(volume_of(mesh.lines))
  for _, fraction in ipairs(fractions) do
    local near, far, refused, largest = 0, 0, 0, 0
    for seed = 1, seeds do
      math.randomseed(s.seed, seed)
      local volume, reason = volume_of(without_faces(mesh.lines, fraction))
      if not volume then
        refused = refused + 1
        print(("%s without %g %%, seed %d: %s"):format(mesh.name, 100 * fraction, seed, reason))
      else
        local err = volume / whole - 1
        if math.abs(err) <= tolerance then near = near + 1 else far = far + 1 end
        if math.abs(err) > math.abs(largest) then largest = err end
      end
    end
    total, within = total + seeds, within + near
    rows[#rows + 1] = {mesh.name, 100 * fraction, near, far, refused,
                       ("%+.2f"):format(100 * largest)}
  end
end

print(s.format_table(rows, {columns = {"mesh", "faces removed [%]", "within 2 %", "farther off",
                                       "refused", "largest error [%]"}}))
print(("%d of %d meshes (%.1f %%) have the volume of the whole one within %g %%"):format(
  within, total, 100 * within / total, 100 * tolerance))
if within < goal * total then os.exit(1) end
