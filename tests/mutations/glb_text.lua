-- Takes a .glb of springlod apart, puts it together again, and computes its checksum as
-- docs/asset-format.md defines it.

local glb_text = {}

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

-- CRC-32 of zlib, a byte at a time.
local crc_of_byte = {}
for byte = 0, 255 do
  local crc = byte
  for _ = 1, 8 do crc = crc >> 1 ~ (crc & 1 == 1 and 0xedb88320 or 0) end
  crc_of_byte[byte] = crc
end

local function crc32(bytes)
  local crc = 0xffffffff
  for at = 1, #bytes do crc = crc >> 8 ~ crc_of_byte[(crc ~ bytes:byte(at)) & 255] end
  return crc ~ 0xffffffff
end

-- The checksum that the asset states; nil if its JSON is not that of an asset.
function glb_text.stated_checksum(json)
  return json:match('"SPRINGLOD_lod_chain":{"checksum":"(crc32:%x+)"')
end

-- The checksum of an asset that states one.
function glb_text.checksum(json, binary)
  return ("crc32:%08x"):format(crc32(glb_text.join(
    glb_text.with_checksum(json, "crc32:00000000"), binary)))
end

-- The JSON text with another checksum.
function glb_text.with_checksum(json, checksum)
  return (json:gsub('"checksum":"[^"]*"', '"checksum":"' .. checksum .. '"', 1))
end

return glb_text
