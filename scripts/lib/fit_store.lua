-- The folder that keeps the state of a fit of levels (the option store of calibrations) while a
-- command runs, so that an interrupted command resumes.

local s = require "springlod"
local command = require "lib.command"

local fit_store = {}

-- Removes the files of the fit, and the folder if it holds nothing else.
function fit_store.remove(folder)
  if not s.is_folder(folder) then return end
  for _, path in ipairs(s.files(folder, {endings = {".bin", ".txt"}})) do
    local name = command.base_name(path)
    if name == "about.txt" or name:find("part%-%d+%.bin$") then os.remove(path) end
  end
  os.remove(folder)
end

return fit_store
