-- Materials of samples/ball.obj, ten times as stiff as in ball_materials.lua: the ball keeps its
-- shape when it hits the floor at a few m/s.
return {
  core = {young = "10 MPa", density = 1000, damping = "4 ms", colour = "#8c3b3b"},
  shell = {young = "1 MPa", density = 200, damping = "4 ms", colour = "#6fb98f"},
}
