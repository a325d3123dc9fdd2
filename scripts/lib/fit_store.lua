-- The folder that keeps the state of a fit of levels (the option store of calibrations) while a
-- command runs, so that an interrupted command resumes.

local command = require "lib.command"

local fit_store = {}

-- Removes the files of the fit, and the folder if it holds nothing else.
function fit_store.remove(folder)
  command.clear_folder(folder, {".bin", ".txt"}, function(name)
    return name == "about.txt" or name:find("part%-%d+%.bin$")
  end)
end

return fit_store
