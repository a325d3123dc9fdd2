-- 64-bit hash of the content of a file (FNV-1a; Fowler, Noll and Vo).

local block = 4096 -- [bytes]; string.byte returns only a few thousand values at once

return function(path)
  local file, reason = io.open(path, "rb")
  if not file then error("cannot read " .. reason, 0) end
  local hash = 0xcbf29ce484222325
  for text in function() return file:read(block) end do
    for _, byte in ipairs{text:byte(1, -1)} do hash = (hash ~ byte) * 0x100000001b3 end
  end
  file:close()
  return ("%016x"):format(hash)
end
