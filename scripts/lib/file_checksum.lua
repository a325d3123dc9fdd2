-- 64 bits that tell the content of a file from another's (Fowler, Noll and Vo's FNV-1a).

local piece = 4096 -- bytes at a time; string.byte returns no more than some thousands

return function(path)
  local file, reason = io.open(path, "rb")
  if not file then error("cannot read " .. reason, 0) end
  local hash = 0xcbf29ce484222325
  for text in function() return file:read(piece) end do
    for _, byte in ipairs{text:byte(1, -1)} do hash = (hash ~ byte) * 0x100000001b3 end
  end
  file:close()
  return ("%016x"):format(hash)
end
