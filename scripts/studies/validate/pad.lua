-- A flat block between two plates that hold its faces.

local pad = {}

pad.size = {1, 1, 0.5} -- [m]
pad.young = 1e6 -- [Pa]
pad.ratios = {0.45, 0.49} -- of Poisson
pad.press = 1e-3 -- of the height: small, so that the answer is that of linear elasticity [1]

return pad
