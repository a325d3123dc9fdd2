-- Import many damaged meshes, and count what becomes of them:
--   springlod run tests/mutations/meshes.lua -- COUNT FILE...
-- Damages the files in turn, each in another way, imports them, and voxelizes what is a mesh.
-- Prints a row for each format: imported, refused by us, refused because assimp crashed or did not
-- end, and errors of any other kind and calls that take long, which are bugs. Exit code 1 if there
-- are any; their files are kept as mutant-NUMBER in the current folder.

local s = require "springlod"
local mutation_run = require "mutation_run"

mutation_run.run{
  count = (...),
  files = {select(2, ...)},
  title = "format",
  group = function(path) return path:match("%.%w+$"):lower() end,
  damage = function(bytes) return mutation_run.damaged(bytes, mutation_run.damages) end,
  use = function(path)
    local mesh = s.import(path)
    local size = 0
    for axis = 1, 3 do size = math.max(size, mesh.max[axis] - mesh.min[axis]) end
    s.voxelize(mesh, {cell = size / 20})
  end,
  done = "imported",
  crash = "the reader of this format",
}
