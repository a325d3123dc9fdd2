-- Convert meshes to LOD assets.

local s = require "springlod"
local command = require "lib.command"
local certificates = require "lib.certificates"
local conversion = require "lib.conversion"
local fit_store = require "lib.fit_store"
local manifest = require "lib.manifest"
local show = require "lib.show"
local simplify_options = require "lib.simplify_options"

local parser = command.parser("convert", "Convert meshes to LOD assets. Each asset is one .glb "
  .. "with the base model, its coarser levels and the mesh. By default, the levels are compact "
  .. "groups of nodes, fitted to the base, and touch obstacles at its surface. Several meshes, or "
  .. "a folder or a manifest, form a batch, which continues after a failed file. An interrupted "
  .. "fit resumes when the same command is run again.", conversion.flag_words)
parser:argument("mesh", "mesh files, or a folder of mesh files"):args("*")
command.one_line(parser:option("-o --out", "asset to write, NAME.glb (default: the mesh's name, in "
  .. "this folder); in a batch, a folder (default: out)"):target("output"):argname("<asset>"))
parser:option("--manifest", "Lua file that lists the meshes of a batch with their own options and "
  .. "outputs; the options of the command are for all"):argname("<file.lua>")
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
if args.manifest and #args.mesh > 0 then
  parser:error("--manifest takes the place of the meshes")
end
if not args.manifest and #args.mesh == 0 then parser:error("missing argument 'mesh'") end

local preset, options -- of s.simplify
local words = arg     -- the arguments that `args` has been read from
local output, meshes = args.output, args.mesh

-- Takes what the arguments ask for. `refuse` gets the message about options that contradict.
local function settle(refuse)
  preset = conversion.presets[args.paper and "paper" or args.fast and "fast" or "best"]
  options = simplify_options.read(args, preset.simplify)
  if args.resume and options.calibrate ~= "modes" then
    refuse("--resume needs --calibrate modes")
  end
  if options.levels == 0 then options.calibrate = "none" end -- nothing is fitted
  conversion.load_materials(args)
end

if not args.manifest then
  local settled, reason = command.try(settle, function(message) parser:error(message) end)
  if not settled then command.fail("%s", reason) end
end

-- The folder that stores the calibration of an asset while it runs.
local function store_of(asset)
  if options.calibrate ~= "modes" then return nil end
  if not args.resume then return (asset:gsub("%.glb$", "")) .. ".calibration" end
  return args.resume:gsub("/*$", "") .. "/" .. command.stem(asset)
end

local function refuse_to_overwrite(path, asset)
  for _, mesh in ipairs{path, table.unpack(meshes)} do
    if s.same_file(mesh, asset) then
      error(("the asset would overwrite %s; give -o another name"):format(mesh), 0)
    end
  end
end

local written = {}

-- One base model to the asset at `asset`.
local function convert_base(base, path, asset)
  if written[asset] then
    error(("the asset would overwrite %s, made from %s; rename one of the meshes"):format(
      asset, written[asset]), 0)
  end
  refuse_to_overwrite(path, asset)
  local store = store_of(asset)
  local function finish()
    local chain = s.simplify(base, options)
    s.save(asset, chain, {command = conversion.command_line(words, args, path)})
    if store and not args.resume then fit_store.remove(store) end
    written[asset] = path
    return chain
  end
  if not store then return finish() end
  options.calibration = options.calibration or {}
  options.calibration.store = store
  conversion.announce_fit(base)
  return s.in_folder(store, finish, {command = "convert", resumes = true})
end

-- The whole conversion: mesh -> cells -> lattices -> levels -> assets. Returns a list of the bodies
-- that become models: asset, base, and chain or, if one of several failed, the reason.
local function convert(path, asset)
  refuse_to_overwrite(path, asset)  -- before the work
  local bases = conversion.bases(args, preset, path)
  if #bases == 1 then
    return {{asset = asset, base = bases[1], chain = convert_base(bases[1], path, asset)}}
  end
  local bodies = {}
  for number, base in ipairs(bases) do
    local name = asset:gsub("%.[^.]*$", ("-%d%%0"):format(number))
    local ok, result = command.try(convert_base, base, path, name)
    bodies[number] = {asset = name, base = base, chain = ok and result or nil,
                      reason = not ok and result or nil}
  end
  return bodies
end

local function failed_count(bodies)
  local failed = 0
  for _, body in ipairs(bodies) do if body.reason then failed = failed + 1 end end
  return failed
end

local function level_rows(chain)
  local rows = {}
  for i, level in ipairs(chain.levels) do
    rows[i] = {i - 1, level.node_count, level.spring_count, level.corner_count, level.border_count,
               show.measured(s.stable_step(level), "time")}
  end
  return rows
end

local level_columns = {"level", "nodes", "springs", "corners", "border", "stable step"}

local function node_counts(chain)
  local counts = {}
  for i, level in ipairs(chain.levels) do counts[i] = tostring(level.node_count) end
  return table.concat(counts, " -> ")
end

-- A row for each body of a mesh that became several assets.
local function body_rows(bodies)
  local rows = {}
  for number, body in ipairs(bodies) do
    rows[number] = {number, show.quantity(body.base.volume, "volume"),
                    body.chain and node_counts(body.chain) or "failed", body.reason or body.asset}
  end
  return rows
end

local body_columns = {"body", "volume", "nodes", "asset or reason"}

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

-- The asset of one mesh if -o is not given: in the current folder, and never the mesh itself.
local function asset_beside(mesh)
  local name = command.stem(mesh) .. ".glb"
  return s.same_file(mesh, name) and command.stem(mesh) .. "-lod.glb" or name
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
    names[i] = output:gsub("/*$", "") .. "/" .. name .. ".glb"
  end
  return names
end

-- The meshes of the manifest, each with its asset.
local function manifest_jobs()
  local jobs = manifest.read(args.manifest, arg)
  local paths, unnamed = {}, {}
  for _, job in ipairs(jobs) do
    if not job.problem then paths[#paths + 1] = job.mesh end
    if not job.output then unnamed[#unnamed + 1] = job.mesh end
  end
  output = output or "out"
  local names, named = asset_names(unnamed), 0
  for _, job in ipairs(jobs) do
    if not job.output then named = named + 1 end
    job.asset = job.output or names[named]
  end
  meshes = paths
  return jobs
end

local function convert_job(job)
  if job.problem then error(job.problem, 0) end
  if job.words then
    local function refuse(message) error(manifest.message(job, message), 0) end
    local ok, parsed = parser:pparse(job.words)
    if not ok then refuse(parsed:gsub("%s*\nDid you", "; did you")) end
    args, words = parsed, job.words
    settle(refuse)
    if not job.asset:lower():find("%.glb$") then
      refuse(("output '%s' must end in .glb"):format(job.asset))
    end
  end
  return convert(job.mesh, job.asset)
end

local function convert_one(path)
  output = output or asset_beside(path)
  if not output:lower():find("%.glb$") then
    parser:error(("-o '%s' must end in .glb"):format(output))
  end
  local ok, bodies = command.try(convert, path, output)
  if not ok then command.fail("cannot convert %s: %s", path, bodies) end
  for _, body in ipairs(bodies) do
    if body.chain then
      print(s.format_table(level_rows(body.chain), {columns = level_columns}))
      certificates.print(s.info(body.chain).levels)
      certificates.warn_of_faults(body.chain, body.asset)
      s.say("wrote " .. body.asset)
    end
  end
  if #bodies == 1 then
    s.say(("next: springlod render %s draws its levels; springlod compare %s --scenario FILE.lua "
      .. "runs them"):format(command.shell_line{output}, command.shell_line{output}))
  end
  if #bodies > 1 then print(s.format_table(body_rows(bodies), {columns = body_columns})) end
  local failed = failed_count(bodies)
  if failed > 0 then command.fail("%d of %d bodies failed", failed, #bodies) end
end

local function convert_batch(jobs)
  local rows, failed = {}, 0
  for _, job in ipairs(jobs) do
    s.say(job.mesh)
    local ok, bodies = command.try(convert_job, job)
    if not ok then bodies = {{reason = bodies}} end
    if failed_count(bodies) > 0 then failed = failed + 1 end
    for _, body in ipairs(bodies) do
      if body.chain then certificates.warn_of_faults(body.chain, body.asset) end
      rows[#rows + 1] = {job.mesh, body.chain and "converted" or "failed",
                         body.chain and node_counts(body.chain) or "", body.reason or body.asset}
    end
  end
  print(s.format_table(rows, {columns = {"mesh", "result", "nodes", "asset or reason"}}))
  if failed > 0 then
    command.fail("%d of %d mesh%s failed", failed, #jobs, #jobs == 1 and "" or "es")
  end
end

if args.manifest then
  local ok, jobs = command.try(manifest_jobs)
  if not ok then command.fail("cannot read --manifest: %s", jobs) end
  return convert_batch(jobs)
end
local paths, batch = find_meshes()
if not batch then return convert_one(paths[1]) end
output = output or "out"
if output:lower():find("%.glb$") then
  parser:error(("-o '%s' must be a folder for several meshes"):format(output))
end
local jobs, assets = {}, asset_names(paths)
for i, path in ipairs(paths) do jobs[i] = {mesh = path, asset = assets[i]} end
convert_batch(jobs)
