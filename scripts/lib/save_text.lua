-- Writes text to a file in an existing folder. It writes a temporary file and renames it, so that
-- an interruption leaves the old file intact.

return function(path, text)
  local file = assert(io.open(path .. ".part", "w"))
  assert(file:write(text))
  assert(file:close())
  assert(os.rename(path .. ".part", path))
end
