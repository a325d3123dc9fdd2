-- A cantilever with a square cross-section: Timoshenko's beam, and its model.

local s = require "springlod"

local cantilever = {}

-- The bar lies along x, is clamped at x = 0 and loaded at x = length [m].
local height, slenderness = 0.1, 20
local length = slenderness * height
local young, density = 1e7, 1000
local frequency_count = 3

cantilever.height, cantilever.slenderness, cantilever.young = height, slenderness, young
-- The values of a cantilever: tip deflection under 1 N [m], and frequencies [Hz].
cantilever.names = {"tip", "f1", "f2", "f3"}

-- Shear coefficient of a rectangle (Cowper 1966).
function cantilever.shear_coefficient(poisson)
  return 10 * (1 + poisson) / (12 + 11 * poisson)
end

-- Stiffnesses of a beam with a square cross-section: of bending [N m2] and of shearing [N].
local function stiffnesses(beam)
  return beam.young * beam.height ^ 4 / 12, cantilever.shear_coefficient(beam.poisson)
    * beam.young / (2 * (1 + beam.poisson)) * beam.height ^ 2
end

-- Frequency equation of a clamped-free beam with shear and rotary inertia (Huang 1961); its roots
-- are b = omega length^2 sqrt(density area / bending).
local function frequency_equation(b, beam)
  local bending, shearing = stiffnesses(beam)
  local rotary = beam.height ^ 2 / (12 * beam.length ^ 2)
  local shear = bending / (shearing * beam.length ^ 2)
  local root = math.sqrt((rotary - shear) ^ 2 + 4 / b ^ 2)
  local alpha = math.sqrt((root - rotary - shear) / 2)
  local beta = math.sqrt((root + rotary + shear) / 2)
  local function cosh(x) return (math.exp(x) + math.exp(-x)) / 2 end
  local function sinh(x) return (math.exp(x) - math.exp(-x)) / 2 end
  return 2 + (b ^ 2 * (rotary - shear) ^ 2 + 2) * cosh(b * alpha) * math.cos(b * beta)
    - b * (rotary + shear) / math.sqrt(1 - b ^ 2 * rotary * shear)
    * sinh(b * alpha) * math.sin(b * beta)
end

local function root_between(f, low, high)
  local rising = f(low) < 0
  for _ = 1, 60 do -- to machine precision
    local middle = (low + high) / 2
    if (f(middle) < 0) == rising then low = middle else high = middle end
  end
  return (low + high) / 2
end

-- The lowest frequencies of Timoshenko's beam [Hz]. beam: length, height [m], young [Pa], density,
-- poisson.
function cantilever.frequencies(beam, count)
  local unit = math.sqrt(stiffnesses(beam) / (beam.density * beam.height ^ 2)) / beam.length ^ 2
    / (2 * math.pi)
  local function equation(b) return frequency_equation(b, beam) end
  local found = {}
  local step, b = 0.1, 0.1 -- roots lie at 3.5, 21, 58: far apart
  while #found < count do
    if equation(b) * equation(b + step) <= 0 then
      found[#found + 1] = unit * root_between(equation, b, b + step)
    end
    b = b + step
  end
  return found
end

-- The values of Timoshenko's beam.
function cantilever.timoshenko(poisson)
  local beam = {length = length, height = height, young = young, density = density,
                poisson = poisson}
  local bending, shearing = stiffnesses(beam)
  local deflection = length ^ 3 / (3 * bending) + length / shearing -- per newton
  return {deflection, table.unpack(cantilever.frequencies(beam, frequency_count))}
end

-- A lattice with `cells` cells across the height; `options` of s.lattice.
function cantilever.model(options, cells, poisson)
  return s.lattice(s.grid{
    cell = height / cells,
    size = {slenderness * cells, cells, cells},
    materials = {bar = {young = young, density = density, damping = 0, poisson = poisson}},
    fill = function() return "bar" end,
  }, options)
end

-- Bending modes come in pairs of equal frequency, as the section is square. Torsion and extension
-- do not move the middle of the end face transversally, which identifies bending.
local function bending_frequencies(model, modes, end_face)
  local found = {}
  for _, mode in ipairs(modes) do
    local across = {0, 0}
    for number, share in pairs(end_face) do
      across[1] = across[1] + share * mode.shape[number][2]
      across[2] = across[2] + share * mode.shape[number][3]
    end
    -- 4 for a slender beam, whose tip amplitude is twice the rms amplitude.
    local tip = (across[1] ^ 2 + across[2] ^ 2) * model.mass
    if tip > 1 then found[#found + 1] = mode.frequency end
  end
  local pairs_of = {}
  for i = 1, frequency_count do
    local one, other = found[2 * i - 1], found[2 * i]
    assert(other and other - one < 1e-3 * one, "bending modes of a square bar come in pairs")
    pairs_of[i] = (one + other) / 2
  end
  return pairs_of
end

-- What holds a model with `cells` cells across: the first layer of nodes, which is on the end face
-- for `corners`, half a cell inside for `centers`.
function cantilever.clamped(cells)
  return function(node) return node.x < 0.75 * height / cells end
end

-- The nodes beyond x, a layer: each with its fraction of the area, which equals that of the volume.
function cantilever.layer_beyond(x, model)
  local end_face, sum = {}, 0
  for _, node in ipairs(model:nodes()) do
    if node.x > x then
      end_face[node.number] = node.volume
      sum = sum + node.volume
    end
  end
  for number, volume in pairs(end_face) do end_face[number] = volume / sum end
  return end_face
end

-- The last layer of a model with `cells` cells across.
function cantilever.end_face(model, cells)
  return cantilever.layer_beyond(length - 0.75 * height / cells, model)
end

-- The values of a model with `cells` cells across.
function cantilever.measure(model, cells)
  local clamped, end_face = cantilever.clamped(cells), cantilever.end_face(model, cells)
  local force = {} -- 1 N in total, evenly distributed
  for number, share in pairs(end_face) do force[number] = {0, 0, share} end
  local bent = s.deflect(model, {anchored = clamped, force = force})
  local deflection = 0
  for number, share in pairs(end_face) do
    deflection = deflection + share * bent.displacement[number][3]
  end
  local modes = s.modes(model, {count = 12, anchored = clamped, seed = s.seed})
  return {deflection, table.unpack(bending_frequencies(model, modes, end_face))}
end

return cantilever
