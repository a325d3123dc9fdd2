-- Spring updates per second of one core of this machine.

local s = require "springlod"
local timed_run = require "lib.timed_run"

local least = 0.2 -- of the timed runs [s]

-- A block of a size at which the usual bodies are: neither its start nor memory counts.
local function block()
  local grid = s.grid{
    cell = 0.1, size = {8, 8, 8}, fill = function() return "block" end,
    materials = {block = {young = "1 MPa", density = 1000, damping = "2 ms"}},
  }
  return s.lattice(grid)
end

local rate -- is measured once

return function()
  if not rate then
    local seconds, updates = timed_run.processor(block(), {duration = 0.05}, {}, least)
    rate = updates / seconds
  end
  return rate
end
