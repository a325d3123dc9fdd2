-- Materials of samples/dumbbell.obj, by the material names in the file.
return {
  rod = {young = "10 MPa", density = 1000, damping = "0.5 ms", colour = "#5b7fa6"},
  rubber = {young = "0.2 MPa", density = 1000, damping = "0.5 ms", colour = "#e0803a"},
}
