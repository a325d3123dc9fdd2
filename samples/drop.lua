-- Scenario for samples/beast.obj in cm: a tilted drop on a floor from 25 cm.
return {
  name = "drop",
  duration = "0.8 s",
  throw = {
    position = {0, 0, "25 cm"},
    turn = {axis = {1, 0.4, 0}, angle = "25 deg"},
    spin = {1, 2, 0},
  },
  obstacles = {{name = "floor", plane = {0, 0, 1, 0}, stiffness = 4e7, friction = 0.6}},
}
