-- Start a project: a folder with a mesh, materials, a scene and a script that runs at once.

local s = require "springlod"
local command = require "lib.command"

local parser = command.parser("new", "Start a project: a folder with a mesh, its materials, a "
  .. "scene, a script that makes levels of detail and pictures, and a README with the next "
  .. "commands. The script runs at once: cd NAME && springlod run main.lua.")
parser:argument("name", "folder to make")
parser:option("--mesh", "mesh file to copy into the project (default: a sample, a small animal)")
  :argname("<file>")
parser:option("--unit", "length unit of --mesh (default: as the file declares, else m)")
  :choices(s.choices.unit)
parser:option("--up", "up axis of --mesh (default: as the file or its format defines)")
  :choices(s.choices.up)
local args = parser:parse()

-- The templates stand beside this script.
local templates = arg[0]:gsub("[^/]*$", "") .. "templates/project/"
local sample = {mesh = s.samples .. "/beast.obj", unit = "cm", up = "z"}
-- Cells along the longest side, as convert's default.
local cells = 32
-- Colours of the parts, in their order.
local colours = {"#d9a066", "#5b7fa6", "#6fb98f", "#e0803a", "#8c3b3b", "#7d6fb9"}

local function read(path)
  local file, reason = io.open(path, "rb")
  if not file then error(reason, 0) end
  local content = file:read("a")
  file:close()
  return content
end

-- A length with two digits: "5.2 mm".
local function length(metres)
  for _, unit in ipairs{{1, "m"}, {0.01, "cm"}, {1e-3, "mm"}, {1e-6, "um"}, {1e-9, "nm"}} do
    if metres >= unit[1] then
      local digits = ("%.2g"):format(metres / unit[1]) -- 1.2e+02 for 123
      return ("%g %s"):format(tonumber(digits), unit[2])
    end
  end
  error("the mesh has no size", 0)
end

-- The table of the materials file: an entry for each name that the parts of the mesh have.
local function materials_of(mesh)
  local lines, known = {}, {}
  for _, part in ipairs(mesh.parts) do
    local name = part.material ~= "" and part.material or part.name
    if not known[name] then
      known[name] = true
      local key = name:find("^[%a_][%w_]*$") and name or ("[%q]"):format(name)
      lines[#lines + 1] = ("  %s = {preset = \"ecoflex_00_30\", poisson = 0.25, damping_ratio = "
        .. "0.02, colour = %q},"):format(key, colours[#lines % #colours + 1])
    end
  end
  return table.concat(lines, "\n")
end

-- What the templates name in braces.
local function values_of(mesh, from, name, file)
  local longest = 0
  for axis = 1, 3 do longest = math.max(longest, mesh.max[axis] - mesh.min[axis]) end
  local drop = 2 * longest
  local import, convert = {}, {}
  for _, option in ipairs{"unit", "up"} do
    if from[option] then
      import[#import + 1] = ("%s = %q"):format(option, from[option])
      convert[#convert + 1] = (" --%s %s"):format(option, from[option])
    end
  end
  return {
    name = name, mesh = file, cell = length(longest / cells), materials = materials_of(mesh),
    import = "{" .. table.concat(import, ", ") .. "}", convert = table.concat(convert),
    height = length(drop),
    duration = ("%.2g s"):format(3 * math.sqrt(2 * (drop - longest / 2) / 9.81)),
  }
end

local function make(path)
  local name = command.base_name(path)
  if not name:find("^%w[%w._-]*$") then
    error(("a project's name has letters, digits, '.', '_' and '-' alone: '%s'"):format(name), 0)
  end
  if s.is_folder(path) or command.exists(path) then
    error("it exists already; choose another name", 0)
  end
  local from = args.mesh and {mesh = args.mesh, unit = args.unit, up = args.up} or sample
  local mesh = s.import(from.mesh, {unit = from.unit, up = from.up})
  local file = command.base_name(from.mesh)
  if not file:find("^%w[%w._-]*$") then file = "body" .. file:match("%.%w+$") end
  local values = values_of(mesh, from, name, file)
  s.save_text(path .. "/" .. file, read(from.mesh))
  for _, template in ipairs{"README.md", "main.lua", "materials.lua", "scene.lua"} do
    local text = read(templates .. template .. ".in"):gsub("{(%l+)}", values)
    s.save_text(path .. "/" .. template, text)
  end
end

local path = args.name:gsub("/+$", "")
local ok, reason = command.try(make, path)
if not ok then command.fail("cannot make %s: %s", path, reason) end
print(("made %s; next:\n  cd %s\n  springlod run main.lua"):format(path, command.shell_line{path}))
