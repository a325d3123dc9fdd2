-- Convert meshes to LOD assets.

local s = require "springlod"
local command = require "lib.command"
local certificates = require "lib.certificates"
local conversion = require "lib.conversion"
local fit_store = require "lib.fit_store"
local simplify_options = require "lib.simplify_options"

local parser = command.parser("convert", "Convert meshes to LOD assets. Each asset is one .glb "
  .. "with the base model, its coarser levels and the mesh. By default, the levels are compact "
  .. "groups of nodes, fitted to the base, and touch obstacles at its surface. Several meshes, or "
  .. "a folder, form a batch, which continues after a failed file. An interrupted fit resumes when "
  .. "the same command is run again.")
parser:argument("mesh", "mesh files, or a folder of mesh files"):args("+")
parser:option("-o", "asset to write, NAME.glb; in a batch, a folder")
  :target("output"):argname("<asset>"):count(1)
parser:mutex(
  parser:flag("--fast", "only merge: no fit and no certificate"),
  parser:flag("--paper", "do what the paper does: nodes at cell centers, no volumes, standard "
    .. "grouping, no fit, contact at the nodes"))
conversion.add_body_options(parser)
parser:option("--resume", "folder for the intermediate results of the fit; it is kept (default: "
  .. "NAME.calibration beside the asset, removed when the asset is written)")
  :argname("<folder>")
simplify_options.add(parser, conversion.presets.best.simplify)
local args = parser:parse()
local preset = conversion.presets[args.paper and "paper" or args.fast and "fast" or "best"]
local options = simplify_options.read(args, preset.simplify)
if args.resume and options.calibrate ~= "modes" then
  parser:error("--resume needs --calibrate modes")
end
conversion.load_materials(args)

-- The folder that stores the calibration of an asset while it runs.
local function store_of(asset)
  if options.calibrate ~= "modes" then return nil end
  if not args.resume then return (asset:gsub("%.glb$", "")) .. ".calibration" end
  return args.resume:gsub("/*$", "") .. "/" .. command.stem(asset)
end

local function refuse_to_overwrite(path, asset)
  for _, mesh in ipairs{path, table.unpack(args.mesh)} do
    if s.same_file(mesh, asset) then
      error(("the asset would overwrite %s; give -o another name"):format(mesh), 0)
    end
  end
end

-- The whole conversion: mesh -> cells -> lattice -> levels -> asset.
local function convert(path, asset)
  refuse_to_overwrite(path, asset)
  local base = conversion.base(args, preset, path)
  local store = store_of(asset)
  local function finish()
    local chain = s.simplify(base, options)
    s.save(asset, chain, {command = conversion.command_line(arg, args, path)})
    if store and not args.resume then fit_store.remove(store) end
    return chain
  end
  if not store then return finish() end
  options.calibration = options.calibration or {}
  options.calibration.store = store
  conversion.announce_fit(base)
  return s.in_folder(store, finish, {command = "convert", resumes = true})
end

local function level_rows(chain)
  local rows = {}
  for i, level in ipairs(chain.levels) do
    rows[i] = {i - 1, level.node_count, level.spring_count, level.end_count, level.corner_count,
               level.border_count, ("%.4g"):format(s.stable_step(level))}
  end
  return rows
end

local level_columns = {"level", "nodes", "springs", "ends", "corners", "border",
                       "stable step [s]"}

local function node_counts(chain)
  local counts = {}
  for i, level in ipairs(chain.levels) do counts[i] = tostring(level.node_count) end
  return table.concat(counts, " -> ")
end

-- The mesh files given, and whether they form a batch: a folder or more than one file.
local function find_meshes()
  local paths, batch = {}, #args.mesh > 1
  for _, path in ipairs(args.mesh) do
    if s.is_folder(path) then
      batch = true
      local found = s.files(path, {endings = s.mesh_endings})
      if #found == 0 then
        command.fail("cannot convert %s: the folder holds no meshes (%s)", path,
                     table.concat(s.mesh_endings, " "))
      end
      table.move(found, 1, #found, #paths + 1, paths)
    else
      paths[#paths + 1] = path
    end
  end
  return paths, batch
end

-- A name for every asset of a batch. Meshes whose names differ only in the extension keep it in the
-- asset's name.
local function asset_names(paths)
  local uses, names = {}, {}
  for _, path in ipairs(paths) do
    uses[command.stem(path)] = (uses[command.stem(path)] or 0) + 1
  end
  local taken = {}
  for i, path in ipairs(paths) do
    local name = command.stem(path)
    if uses[name] > 1 then name = command.base_name(path):gsub("%.", "_") end
    while taken[name] do name = name .. "_" end
    taken[name] = true
    names[i] = args.output:gsub("/*$", "") .. "/" .. name .. ".glb"
  end
  return names
end

local paths, batch = find_meshes()
if not batch then
  if not args.output:lower():find("%.glb$") then
    parser:error(("-o '%s' must end in .glb"):format(args.output))
  end
  local ok, chain = command.try(convert, paths[1], args.output)
  if not ok then command.fail("cannot convert %s: %s", paths[1], chain) end
  print(s.format_table(level_rows(chain), {columns = level_columns}))
  certificates.print(s.info(chain).levels)
  s.say("wrote " .. args.output)
  return
end

if args.output:lower():find("%.glb$") then
  parser:error(("-o '%s' must be a folder for several meshes"):format(args.output))
end
local rows, failed, assets = {}, 0, asset_names(paths)
for i, path in ipairs(paths) do
  s.say(path)
  local ok, result = command.try(convert, path, assets[i])
  if not ok then failed = failed + 1 end
  rows[i] = {path, ok and "converted" or "failed", ok and node_counts(result) or "",
             ok and assets[i] or result}
end
print(s.format_table(rows, {columns = {"mesh", "result", "nodes", "asset or reason"}}))
if failed > 0 then command.fail("%d of %d meshes failed", failed, #paths) end
