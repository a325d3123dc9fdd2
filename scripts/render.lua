-- Draw a picture of the levels of an asset, or of a mesh.

local s = require "springlod"
local asset_or_mesh = require "lib.asset_or_mesh"
local certificates = require "lib.certificates"
local command = require "lib.command"
local show = require "lib.show"

local axes = {x = 1, y = 2, z = 3}

local parser = command.parser("render", "Draw a picture of the levels of an asset side by side, or "
  .. "of a mesh. Several files share one picture, and one scale unless they differ in size.")
parser:argument("file", "a .glb asset, written by convert or s.save, or a mesh file"):args("+")
command.one_line(parser:option("-o --out", "picture to write (default: NAME-glb.png for NAME.glb, "
  .. "in this folder)"):argname("<picture.png>"))
parser:option("--level", "levels to draw, such as 0,2; 0 is the base (default: all)")
  :convert(command.numbers("--level", 0, true)):argname("<list>")
parser:flag("--surface", "draw the surface, transparent, over the nodes and springs of levels")
parser:option("--cut", "keep the half of each body behind a plane through its center, across this "
  .. "axis, so that the inside shows"):choices{"x", "y", "z"}
parser:option("--unit", "length unit of a mesh file (default: as the file declares, else m)")
  :choices(s.choices.unit)
parser:option("--up", "up axis of a mesh file (default: as the file or its format defines)")
  :choices(s.choices.up)
parser:option("--width", "width of a panel in pixels"):convert(command.whole("--width", 1, 16384))
  :default("640")
parser:option("--height", "height of a panel in pixels"):default("480")
  :convert(command.whole("--height", 1, 16384))
parser:option("--columns", "number of panels in a row (default: all)")
  :convert(command.whole("--columns", 1, 1000))
parser:option("--azimuth", "azimuth of the camera about the vertical, from x, in degrees")
  :convert(command.number("--azimuth", -360, true, 360)):default("-70")
parser:option("--elevation", "elevation of the camera, in degrees")
  :convert(command.number("--elevation", -90, true, 90)):default("15")
parser:option("--title", "title above all panels")
local args = parser:parse()
-- Neither NAME.png, which may be a texture, nor one picture for NAME.obj and NAME.glb.
local out = args.out or command.base_name(args.file[1]):gsub("%.(%w+)$", "-%1") .. ".png"
if not out:lower():find("%.png$") then parser:error(("-o '%s' must end in .png"):format(out)) end

-- The size of a box: "20 x 20 x 5.6 mm".
local function size_text(low, high)
  local side = 0
  for axis = 1, 3 do side = math.max(side, high[axis] - low[axis]) end
  local unit = show.quantity(side, "length"):match("%a+$")
  local in_unit, sides = s.quantity("1 " .. unit, "length"), {}
  for axis = 1, 3 do
    sides[axis] = show.number((high[axis] - low[axis]) / in_unit, 3, side / in_unit)
  end
  return ("%s %s"):format(table.concat(sides, " x "), unit)
end

-- The plane through a center, across the axis of --cut, that keeps what is on the far side of the
-- camera.
local function cut_through(center)
  if not args.cut then return nil end
  local axis, normal = axes[args.cut], {0, 0, 0}
  local azimuth, elevation = math.rad(args.azimuth), math.rad(args.elevation)
  local toward_eye = ({math.cos(azimuth), math.sin(azimuth), math.sin(elevation)})[axis]
  normal[axis] = toward_eye > 0 and -1 or 1
  return {normal[1], normal[2], normal[3], normal[axis] * center[axis]}
end

-- Panels of several files state their sizes: they may have different scales.
local function panel_of(subject, title, center, low, high)
  if #args.file > 1 then title = title .. "\n" .. size_text(low, high) end
  return {subject, title = title, cut = cut_through(center)}
end

local function panel_of_model(model, name)
  local bounds = model.bounds
  local function counted(count, what)
    return ("%d %s%s"):format(count, what, count == 1 and "" or "s")
  end
  local title = ("%s: %s, %s"):format(name, counted(model.node_count, "node"),
    counted(model.spring_count, "spring"))
  return panel_of(model, title, model.center, bounds.low, bounds.high)
end

local function panel_of_mesh(mesh, name)
  local center = {}
  for axis = 1, 3 do center[axis] = (mesh.min[axis] + mesh.max[axis]) / 2 end
  return panel_of(mesh, name, center, mesh.min, mesh.max)
end

local function levels_of(chain)
  if not args.level then
    local all = {}
    for level = 0, chain.coarsest do all[level + 1] = level end
    return all
  end
  for _, level in ipairs(args.level) do
    if level > chain.coarsest then
      command.fail("--level %d: the asset has the levels 0 to %d", level, chain.coarsest)
    end
  end
  return args.level
end

-- The panels; a mesh among models has nothing but its surface.
local function panels()
  local list, meshes = {}, {}
  for _, path in ipairs(args.file) do
    local chain, mesh = asset_or_mesh(path, args)
    local prefix = #args.file > 1 and command.stem(path) .. ", " or ""
    if mesh then
      list[#list + 1] = panel_of_mesh(mesh, command.base_name(path))
      meshes[#meshes + 1] = list[#list]
    else
      local levels = levels_of(chain)
      certificates.warn_of_faults(chain, path, levels)
      for _, level in ipairs(levels) do
        list[#list + 1] = panel_of_model(chain[level],
          prefix .. (level == 0 and "base" or "level " .. level))
      end
    end
  end
  if #meshes < #list then
    for _, panel in ipairs(meshes) do panel.surface, panel.surface_opacity = true, 1 end
  end
  return list, #meshes < #list
end

local function render()
  local list, models = panels()
  local style = {}
  if models then
    style = {nodes = true, springs = true, surface = args.surface or false,
             surface_opacity = args.surface and 0.35 or nil}
  end
  style.width, style.height, style.columns = args.width, args.height, args.columns
  style.azimuth, style.elevation, style.title = args.azimuth, args.elevation, args.title
  s.render(out, list, style)
end

local ok, failure = command.try(render)
if not ok then command.fail("cannot draw %s: %s", table.concat(args.file, ", "), failure) end
s.say("wrote " .. out)
