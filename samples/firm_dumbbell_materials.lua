-- Materials of samples/dumbbell.obj: rods ten times and joint a hundred times as stiff as in
-- dumbbell_materials.lua. The body keeps its shape when it hits a wall at 10 m/s.
return {
  rod = {young = "100 MPa", density = 1000, damping = "0.5 ms", colour = "#5b7fa6"},
  rubber = {young = "20 MPa", density = 1000, damping = "0.5 ms", colour = "#e0803a"},
}
