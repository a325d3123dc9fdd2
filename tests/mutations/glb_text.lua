-- Takes a .glb of springlod apart, puts it together again, and computes its checksum as
-- docs/asset-format.md defines it.

local s = require "springlod"

local glb_text = {}

local kLevelArrays = {"rest", "mass", "volume", "contactArea", "border", "material", "ends",
                      "restLength", "stiffness", "damping", "nodeOfBase", "cornerNodes",
                      "cornerYoung", "cornerYoungNumber"}
local kSurfaceArrays = {"positions", "indices", "bindingStart", "bindingNode", "bindingWeight"}

-- Its JSON text and its arrays.
function glb_text.split(bytes)
  local length = ("<I4"):unpack(bytes, 13)
  return bytes:sub(21, 20 + length):gsub(" +$", ""), bytes:sub(29 + length)
end

function glb_text.join(json, binary)
  json = json .. (" "):rep(-#json % 4)
  binary = binary .. ("\0"):rep(-#binary % 4)
  return ("<c4I4I4I4c4"):pack("glTF", 2, 28 + #json + #binary, #json, "JSON") .. json ..
         ("<I4c4"):pack(#binary, "BIN\0") .. binary
end

-- The whole number of a field, or `otherwise`.
local function whole(object, key, otherwise)
  return math.tointeger(tonumber(object:match('"' .. key .. '":(%d+)'))) or otherwise
end

-- Places of the arrays in the binary: lists of {first byte from 1, length}, by view from 1.
function glb_text.views(json)
  local views = {}
  for view in (json:match('"bufferViews":(%b[])') or ""):gmatch("%b{}") do
    views[#views + 1] = {whole(view, "byteOffset", 0) + 1, whole(view, "byteLength", 0)}
  end
  return views
end

local function add_arrays(strings, object, keys, views, binary)
  for _, key in ipairs(keys) do
    local view = views[whole(object, key, -1) + 1]
    local bytes = view and binary:sub(view[1], view[1] + view[2] - 1) or ""
    strings[#strings + 1] = ("<I8"):pack(#bytes) .. bytes
  end
end

local function extension(json) return json:match('"SPRINGLOD_lod_chain":(%b{})') end

-- The checksum of an asset, whose texts must not hold braces or brackets; nil if its JSON is not
-- that of an asset.
function glb_text.checksum(json, binary)
  local ours = extension(json)
  local levels = ours and ours:match('"levels":(%b[])')
  if not levels then return nil end
  local views, strings = glb_text.views(json), {}
  for level in levels:sub(2, -2):gmatch("%b{}") do
    level = level:gsub('"materials":%b[]', ""):gsub('"certificate":%b{}', "")
    add_arrays(strings, level, kLevelArrays, views, binary)
  end
  local surface = ours:match('"surface":(%b{})')
  if surface then
    add_arrays(strings, surface:gsub('"parts":%b[]', ""), kSurfaceArrays, views, binary)
  end
  local rest = ours:gsub('"checksum":"[^"]*",', "")
  strings[#strings + 1] = ("<I8"):pack(#rest) .. rest
  return "xxh3-64:" .. s.hash{text = table.concat(strings)}
end

-- The checksum that the asset states.
function glb_text.stated_checksum(json)
  return (extension(json) or ""):match('"checksum":"([^"]*)"')
end

-- The JSON text with another checksum.
function glb_text.with_checksum(json, checksum)
  return (json:gsub('"checksum":"[^"]*"', '"checksum":"' .. checksum .. '"'))
end

return glb_text
