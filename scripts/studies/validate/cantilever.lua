local cantilever = require "lib.cantilever"
local corrected = require "studies.validate.corrected"

-- What the tables of both lattices at nu = 1/4 tell a user. The limits are those of sizes 4, 8, 16.
local choosing = [[
**Choosing the cell size.** For an error below 2 %, take the default lattice (`corners`) with 8
cells across the thinnest part for deflections, or 6 for frequencies. A bar with one cell across is
nearly twice as stiff as it should be. `corners` converges with order 2. The orders of this table
are below it for two reasons. With one to three cells, terms of higher order are still large, and
more so in the deflection, which is the inverse of the stiffness. With 12 and 16 cells, much of what
remains comes from the clamp: held in full, the face cannot contract, as it does in the theory for
nu above 0. These bars tend to -0.20 % for the deflection and to +0.15 to +0.17 % for the
frequencies, as a bar would that is shorter by a sixtieth of its height; towards that limit the
order is 1.9. `springlod refinement` writes both tables as files, with the orders of straight-line
fits.
]]

local centers = [[
`centers` converges with order 1, and its error is large: its border springs are as stiff as the
inner ones, and its outer nodes lie half a cell inside the surface. Its clamp holds the first layer
of nodes. For this reason, `corners` is the default.
]]

-- A problem for each Poisson's ratio; `options` of s.lattice.
local function problem(name, poisson, options)
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
    source = "Timoshenko's beam, shear coefficient k = 10 (1 + nu) / (12 + 11 nu) of Cowper 1966; "
      .. "tip P L^3 / (3 E I) + P L / (k G A), E = 10 MPa, L = 2 m; frequencies of Huang 1961.",
    size_name = "cells across", sizes = {4, 8, 16}, quick = {2, 4},
    quantities = quantities,
    body = function(cells) return cantilever.model(options or {}, cells, poisson) end,
    measure = cantilever.measure,
  }
end

local quarter = problem("cantilever", 0.25)
quarter.sizes, quarter.notes = {1, 2, 3, 4, 6, 8, 12, 16}, choosing

local other = problem("cantilever_centers", 0.25)
other.title = "Cantilever, the lattice `centers`"
other.sizes, other.notes = {2, 3, 4, 6, 8}, centers
other.body = function(cells) return cantilever.model({style = "centers"}, cells, 0.25) end
for _, quantity in ipairs(other.quantities) do quantity.goal = nil end

local all = {problem("cantilever_0", 0), quarter, other, problem("cantilever_45", 0.45)}
for _, poisson in ipairs{0, 0.25, 0.45} do
  local name = ("cantilever_%d_corrected"):format(100 * poisson)
  local twin = corrected(problem(name, poisson, {bending = "corrected"}), name)
  twin.sizes = {2, 4, 8}
  all[#all + 1] = twin
end
return all
