-- The paper's first scene at the size of samples/ball.obj in dm: the ball is thrown horizontally
-- just above the floor, bounces and rolls until it stops or time is up. Measured: distance
-- travelled.
return {
  name = "roll",
  duration = "12 s",
  throw = {position = {0, 0, 0.6}, velocity = {"3.2 m/s", 0, 0}},
  obstacles = {{name = "floor", plane = {0, 0, 1, 0}, stiffness = 1e6, friction = 0.5}},
  stop = {speed = "0.1 m/s"},
}
