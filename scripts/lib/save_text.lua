-- Writes text as a file in a folder that is there; aside first, so that a file of an earlier run is
-- whole until the new one is.

return function(path, text)
  local file = assert(io.open(path .. ".part", "w"))
  assert(file:write(text))
  assert(file:close())
  assert(os.rename(path .. ".part", path))
end
