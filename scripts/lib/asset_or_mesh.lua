-- Reads a file that may be an asset or a mesh.

local s = require "springlod"
local command = require "lib.command"

-- Returns the chain of an asset, or nil and a mesh; `args` has the unit and up axis of meshes. Ends
-- the command if the file is neither. A .glb file may be an asset or a mesh; files with the other
-- endings of meshes are meshes.
return function(path, args)
  local ending = (path:match("%.%w+$") or ""):lower()
  local may_be_mesh = false
  for _, known in ipairs(s.mesh_endings) do may_be_mesh = may_be_mesh or ending == known end
  local loaded, chain
  if ending == ".glb" or not may_be_mesh then loaded, chain = command.try(s.load, path) end
  if loaded then return chain end
  if may_be_mesh then
    local imported, mesh = command.try(s.import, path, {unit = args.unit, up = args.up})
    if imported then return nil, mesh end
    chain = chain or mesh
  end
  local named = chain:find("^cannot read ") or chain:find(path, 1, true) == 1
  command.fail("%s", named and chain or ("cannot read %s: %s"):format(path, chain))
end
