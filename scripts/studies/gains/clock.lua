-- Gains by the clock: processor time of a run of the base over that of a run of the level.

local s = require "springlod"
local cut_scene = require "lib.cut_scene"
local intervals = require "lib.intervals"
local timed_run = require "lib.timed_run"

local clock = {}

-- How a level and its base are run, with the name of the column in the results. Unless `flight` is
-- set, there are obstacles. `layout` selects the kernel of both. `contact` is what the level
-- touches obstacles with; the base does so with its nodes.
clock.ways = {}
local function add(way) clock.ways[#clock.ways + 1] = way end
for _, contact in ipairs(s.choices.contact) do
  add{column = "clock_" .. contact, contact = contact}
end
add{column = "clock_flight", flight = true}
add{column = "clock_same_kernel", layout = "any shape"}

-- `scene`: a table for s.scenario. `least`: processor time of each measurement [s]; shorter runs
-- are repeated to fill it. Returns for each way, by column, the median with its interval of
-- `repeats` gains, with `updates`: the ratio of the numbers of spring updates, which has no noise.
-- Base and level take turns, so that a change of the machine's speed affects both.
function clock.gains(base, level, scene, repeats, least)
  local empty = cut_scene(scene, scene.duration)
  empty.obstacles = nil
  local gains = {}
  for _, way in ipairs(clock.ways) do
    local place = way.flight and empty or scene
    local ratios, updates = {}, nil
    for turn = 1, repeats do
      local base_time, base_updates = timed_run.processor(base, place, {layout = way.layout}, least)
      local level_time, level_updates = timed_run.processor(level, place,
        {layout = way.layout, contact = way.contact}, least)
      ratios[turn], updates = base_time / level_time, base_updates / level_updates
    end
    gains[way.column] = intervals.median(ratios)
    gains[way.column].updates = updates
  end
  return gains
end

return clock
