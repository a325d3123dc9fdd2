-- Says how far a long work of `total` parts is and how long it will take: call it with the name of
-- each part done.

local s = require "springlod"

return function(total)
  local begun, done = os.time(), 0
  return function(name)
    done = done + 1
    local left = os.difftime(os.time(), begun) / done * (total - done)
    s.say(("%d/%d %s, about %.0f s left"):format(done, total, name, left))
  end
end
