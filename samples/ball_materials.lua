-- Materials of samples/ball.obj: a dense core in a soft shell.
return {
  core = {young = "1 MPa", density = 1000, damping = "4 ms", colour = "#8c3b3b"},
  shell = {young = "0.1 MPa", density = 200, damping = "4 ms", colour = "#6fb98f"},
}
