-- The silicone beam of SORS (arXiv 2512.15994): size and identified material.

local silicone_beam = {}

silicone_beam.length, silicone_beam.height = 0.1, 0.03 -- [m]
silicone_beam.young, silicone_beam.poisson = 236.6e3, 0.316 -- [Pa], [1]
silicone_beam.density = 1089.8 -- [kg/m3]

-- Of a force per mass against the velocity [1/s]: alpha in python/d02a_cantilever_sim2real.py of
-- github.com/srl-ethz/sors. It makes all vibrations decay as exp(-alpha t / 2).
silicone_beam.drag = 6.423

return silicone_beam
