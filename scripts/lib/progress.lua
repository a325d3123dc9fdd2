-- Reports the progress of a job of `total` tasks and the estimated remaining time. Call the
-- returned function with the name of each finished task.

local s = require "springlod"

return function(total)
  local start, done = os.time(), 0
  return function(name)
    done = done + 1
    local left = os.difftime(os.time(), start) / done * (total - done)
    s.say(("%d/%d %s, about %.0f s left"):format(done, total, name, left))
  end
end
