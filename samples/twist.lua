-- Scenario for samples/dumbbell.obj in dm: one end of the dumbbell is held, the other is drawn out
-- and turned, and then held too while the rubber between them vibrates.
local function near_end(sign)
  return function(node) return sign * node.x > 1 end
end

return {
  name = "twist",
  duration = "0.8 s",
  throw = {position = {0, 0, 2}},
  anchored = {
    {name = "vice", nodes = near_end(-1)},
    {name = "grip", nodes = near_end(1), path = {
      {time = "0.3 s", move = {"10 cm", 0, 0}, turn = {axis = {1, 0, 0}, angle = "60 deg"}},
      {time = "0.5 s", move = {"10 cm", 0, 0}, turn = {axis = {1, 0, 0}, angle = "30 deg"}},
    }},
  },
}
