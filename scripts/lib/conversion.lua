-- From a mesh to a base model, as convert does it: options, presets, and the command that makes an
-- asset again.

local s = require "springlod"
local command = require "lib.command"
local lists = require "lib.lists"
local show = require "lib.show"

local conversion = {}

-- What the options of convert are where the user does not give them. `simplify`: those of
-- s.simplify.
conversion.presets = {
  best = {lattice = "corners", volumes = true,
          simplify = {grouping = "compact", calibrate = "modes", contact = "surface"}},
  fast = {lattice = "corners", volumes = true,
          simplify = {grouping = "compact", calibrate = "none", contact = "surface"}},
  paper = {lattice = "centers", volumes = false,
           simplify = {grouping = "standard", calibrate = "none", contact = "nodes"}},
}

-- Options of the API that these commands call otherwise, for command.parser.
conversion.flag_words = {style = "--lattice", core_depth = "--shell"}

-- Adds the options of the mesh, its cells and the lattice.
function conversion.add_body_options(parser)
  parser:group("Body",
    parser:option("--cell", "cell size, such as 2mm (default: longest side / 32)")
      :convert(command.quantity("--cell", "length")),
    parser:option("--unit", "length unit of the file (default: as the file declares, else m)")
      :choices(s.choices.unit),
    parser:option("--up", "up axis of the file (default: as the file or its format defines)")
      :choices(s.choices.up),
    parser:option("--materials", "Lua file that returns {part = {young = ..., density = ...}, ...}")
      :argname("<file.lua>"),
    parser:option("--priority", "order in which parts claim cells that lie in several of them, "
      .. "such as rod,rubber (default: order of the file)"):argname("<parts>"),
    parser:option("--core", "material of --materials for the cells deeper than --shell under the "
      .. "surface"):argname("<material>"),
    parser:option("--shell", "thickness of the shell over the core, such as 5mm")
      :convert(command.quantity("--shell", "length")),
    parser:option("--lattice", "place nodes at cell corners or cell centers (default: corners)")
      :choices(s.choices.lattice),
    parser:option("--bending", "share of cells at free faces: plain stretches exactly, corrected "
      .. "bends and twists as accurately as half the cell size (default: plain)")
      :choices(s.choices.bending),
    parser:flag("--cut-cells", "count cells that the surface cuts by the fraction of them inside, "
      .. "and touch obstacles at points of the surface: for round and slanting surfaces"),
    parser:option("--repair", "treatment of holes and other faults of the mesh")
      :choices(s.choices.repair):default("auto"),
    parser:option("--bodies", "bodies that do not touch: one asset of all, the largest alone, or "
      .. "an asset for each, NAME-1.glb, NAME-2.glb, ...")
      :choices(s.choices.bodies):default("together"),
    parser:option("--hinges", "treatment of cells that touch only along an edge or at a corner")
      :choices(s.choices.hinges):default("report"),
    parser:flag("--no-volumes", "build the model from springs alone; by default, the corners of "
      .. "its cells keep the signs of their volumes, so that soft bodies do not turn inside out"))
end

-- Replaces the path of the materials file by the table that it returns.
function conversion.load_materials(args)
  if not args.materials then return end
  local ok, result = command.try(command.load_table, args.materials)
  if not ok then error("cannot read --materials: " .. result, 0) end
  args.materials = result
end

-- The core of the options, or nil.
local function core_of(args, materials)
  if not args.core and not args.shell then return nil end
  if not (args.core and args.shell) then
    error("--core NAME and --shell THICKNESS belong together; give both or none", 0)
  end
  local material = materials and materials[args.core]
  if not material then
    error(("--core %s: the file of --materials has no material of this name"):format(args.core), 0)
  end
  local named = {name = args.core}
  for key, value in pairs(material) do named[key] = value end
  return {depth = args.shell, material = named}
end

local function words_of(text)
  local words = {}
  for word in (text .. ","):gmatch("%s*(.-)%s*,") do words[#words + 1] = word end
  return words
end

-- The materials without that of the core, unless a part has it too.
local function materials_of_parts(materials, core, mesh)
  local kept, used = {}, {}
  for _, part in ipairs(mesh.parts) do used[part.name], used[part.material] = true, true end
  for name, material in pairs(materials) do
    if name ~= core or used[name] then kept[name] = material end
  end
  return kept
end

-- The grids of the bodies that --bodies asks for.
local function bodies_of(grid, args)
  local count = args.bodies == "together" and grid.body_count or 0 -- counted at each reading
  if count > 1 then
    s.say(("all %d bodies become one model (--bodies largest or separate takes them apart)"):format(
      count))
  end
  return s.bodies(grid, {bodies = args.bodies})
end

-- Bodies that people simulate are rarely larger [m].
local largest = 5

-- Points out a size that can hardly be meant, of a file that does not state its unit.
local function note_size(mesh, base)
  local side = 0
  for axis = 1, 3 do side = math.max(side, mesh.max[axis] - mesh.min[axis]) end
  if not mesh.unit_assumed or side <= largest then return end
  s.say(("the body is %s long and weighs %s; if that is not meant, give --unit"):format(
    show.quantity(side, "length"), show.quantity(base.mass, "mass")))
end

-- The base models of the mesh at `path`, one for each body that --bodies asks for.
function conversion.bases(args, preset, path)
  local core = core_of(args, args.materials)
  local mesh = s.import(path, {unit = args.unit, up = args.up})
  local materials = core and materials_of_parts(args.materials, args.core, mesh) or args.materials
  local grid = s.voxelize(mesh, {
    cell = args.cell, materials = materials, core = core,
    priority = args.priority and words_of(args.priority), repair = args.repair,
    cut_cells = args.cut_cells, for_lattice = true,
  })
  local bases = {}
  for number, body in ipairs(bodies_of(grid, args)) do
    bases[number] = s.lattice(body, {
      style = args.lattice or preset.lattice, hinges = args.hinges,
      volumes = preset.volumes and not args.no_volumes, bending = args.bending,
    })
    if number == 1 then note_size(mesh, bases[1]) end
  end
  return bases
end

-- Time of the fit of two levels of a base of 5000 nodes on two cores [s], and the exponent with
-- which it grows with the number of nodes (docs/convert.md).
local fit_seconds, fit_nodes, fit_growth = 6.5, 5000, 1.35

function conversion.fit_time(base)
  return fit_seconds * (base.node_count / fit_nodes) ^ fit_growth
end

-- Says beforehand how long the fit takes, if it takes long.
function conversion.announce_fit(base)
  local seconds = conversion.fit_time(base)
  if seconds < 5 then return end
  s.say(("fitting the levels of a base of %d nodes takes about %s on two idle cores "
    .. "(--fast merges only)"):format(
    base.node_count, seconds < 90 and ("%.0f s"):format(seconds)
      or ("%.0f minutes"):format(seconds / 60)))
end

-- The arguments of a command without those that do not change the asset: its path and the folder of
-- the fit. In a batch, `path` is the only mesh that is kept.
function conversion.command_line(arguments, args, path)
  local is_mesh = {}
  for _, mesh in ipairs(args.mesh) do is_mesh[mesh] = true end
  local words = lists.joined({"springlod", "convert", path},
    command.without(arguments, {"-o", "--out", "--resume"},
      function(word) return is_mesh[word] end))
  if s.seed ~= 1 then table.move({"--seed", tostring(s.seed)}, 1, 2, #words + 1, words) end
  return command.shell_line(words)
end

return conversion
