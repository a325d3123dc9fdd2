-- Batches of convert by a manifest: a Lua file that returns a list of meshes, each with the options
-- of convert that it needs.
--
--   return {
--     unit = "mm",                                       -- for all
--     {mesh = "bear.obj", cell = "2 mm", materials = "plush.lua", output = "assets/bear.glb"},
--     {mesh = "car.stl", unit = "cm", cut_cells = true},
--   }

local command = require "lib.command"

local manifest = {}

-- The words of the command line that every mesh of the batch shares.
local function shared_words(arguments)
  local own = {["--manifest"] = true, ["-o"] = true, ["--out"] = true}
  local words, skipped = {}, false
  for _, word in ipairs(arguments) do
    local name = word:match("^(%-%-%w+)=") or word:match("^(%-o).") or word
    if not skipped and not own[name] then words[#words + 1] = word end
    skipped = not skipped and own[word] or false
  end
  return words
end

-- Appends options as words: {cell = "2 mm", cut_cells = true} -> --cell "2 mm" --cut-cells.
local function add_words(words, options)
  local names = {}
  for key in pairs(options) do
    if type(key) == "string" and key ~= "mesh" and key ~= "output" then names[#names + 1] = key end
  end
  table.sort(names)
  for _, name in ipairs(names) do
    local value = options[name]
    if type(value) == "table" then value = table.concat(value, ",") end
    if value then words[#words + 1] = "--" .. name:gsub("_", "-") end
    if value and value ~= true then words[#words + 1] = tostring(value) end
  end
end

-- An error message about the options of a job, in the words of its manifest: where they are, and
-- cut_cells for --cut-cells.
function manifest.message(job, text)
  text = text:gsub("%-%-(%a[%w-]*)", function(flag) return (flag:gsub("-", "_")) end)
  local name = text:match("option '([%w_]+)'") or text:match("^([%w_]+):")
  local of_all = name and job.entry[name] == nil
  return ("%s, %s: %s"):format(job.path, of_all and "options of all meshes"
    or "entry " .. job.number, text)
end

local function job_of(list, number, entry, path, arguments)
  if type(entry) ~= "table" or type(entry.mesh) ~= "string" then
    return {mesh = "entry " .. number, problem = ("%s, entry %d: must be a table with a mesh: "
      .. "{mesh = \"bear.obj\", ...}"):format(path, number)}
  end
  local words = shared_words(arguments)
  add_words(words, list)
  add_words(words, entry)
  words[#words + 1] = entry.mesh
  return {mesh = entry.mesh, output = entry.output, words = words, path = path, number = number,
          entry = entry}
end

-- Reads the manifest at `path`. Returns a list of jobs: mesh, output (or nil), and words: the
-- arguments of `convert` for this mesh, of which later ones replace earlier ones. `arguments`: the
-- command line. A job that cannot be done has a `problem` instead, a message.
function manifest.read(path, arguments)
  local list = command.load_table(path)
  if #list == 0 then
    error(("%s lists no meshes; it must return a list: {{mesh = \"bear.obj\"}, ...}"):format(path),
      0)
  end
  local jobs = {}
  for number, entry in ipairs(list) do
    jobs[number] = job_of(list, number, entry, path, arguments)
  end
  return jobs
end

return manifest
