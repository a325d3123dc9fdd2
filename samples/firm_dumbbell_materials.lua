-- Materials of samples/dumbbell.obj, stiffer than in dumbbell_materials.lua, rods ten and joint a
-- hundred times: rods that keep their shape where they hit a wall at 10 m/s.
return {
  rod = {young = "100 MPa", density = 1000, damping = "0.5 ms", colour = "#5b7fa6"},
  rubber = {young = "20 MPa", density = 1000, damping = "0.5 ms", colour = "#e0803a"},
}
