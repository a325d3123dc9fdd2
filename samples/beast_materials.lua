-- One soft material for samples/beast.obj.
return {
  flesh = {young = "60 kPa", density = 1000, damping = "0.3 ms", colour = "#d9a066"},
}
