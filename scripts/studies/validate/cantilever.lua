local cantilever = require "lib.cantilever"

-- A problem for each Poisson's ratio.
local function problem(name, poisson)
  local quantities, timoshenko = {}, cantilever.timoshenko(poisson)
  local units = {"m/N", "Hz", "Hz", "Hz"}
  for i, quantity in ipairs(cantilever.names) do
    quantities[i] = {name = ("%s [%s]"):format(quantity, units[i]), reference = timoshenko[i],
                     goal = 1}
  end
  return {
    name = name,
    title = ("Cantilever, nu = %g"):format(poisson),
    text = "A bar with a square cross-section, 20 times as long as high, is clamped at one end: "
      .. "deflection of the tip under a transverse load, and the three lowest bending frequencies. "
      .. "The clamp holds all nodes of its face, which cannot contract; the beam of the theory "
      .. "can.",
    source = "Timoshenko's beam, shear coefficient of Cowper 1966, frequencies of Huang 1961. More "
      .. "sizes and the other lattice: [refinement.md](refinement.md).",
    size_name = "cells across", sizes = {4, 8, 16}, quick = {2, 4},
    quantities = quantities,
    body = function(cells) return cantilever.model("corners", cells, poisson) end,
    measure = cantilever.measure,
  }
end

return {problem("cantilever_0", 0), problem("cantilever", 0.25), problem("cantilever_45", 0.45)}
