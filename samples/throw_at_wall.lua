-- The paper's second scene at the size of samples/dumbbell.obj in dm: the body is thrown, spinning,
-- at a wall two metres away, bounces off, falls and comes to rest. Measured: distance from the
-- wall.
return {
  name = "throw at a wall",
  duration = "5 s",
  throw = {
    turn = {axis = {0, 1, 0}, angle = "90 deg"}, -- upright
    position = {-2, 0, 2},
    velocity = {"10 m/s", 0, 0},
    spin = {0, "6 rad/s", 0},
  },
  obstacles = {
    {name = "floor", plane = {0, 0, 1, 0}, stiffness = 2e6, friction = 0.5},
    {name = "wall", plane = {-1, 0, 0, 0}, stiffness = 2e6, friction = 0.5},
  },
  measure_from = "wall",
}
