local s = require "springlod"

-- A thin sheet is in plane stress. With nu = 1/3, its waves are those of plane strain, of a half
-- space, with nu' = nu / (1 + nu) = 1/4.
local material = {young = 1e6, density = 1000, damping = 0, poisson = 1 / 3}
local shear_speed = math.sqrt(material.young / (2 * (1 + material.poisson)) / material.density)
local ratio = 0.919402 -- speed over that of shear waves
local length, depth = 6, 2.5 -- of the sheet, in wavelengths of 1 m
local width = 0.8 -- of the packet [m]
local travel = 1 -- way of the packet while its phase is measured [m]
local amplitude = 1e-4 -- of the strain

local k = 2 * math.pi -- wave number [1/m]
local omega = ratio * shear_speed * k -- [rad/s]
-- Decay of the longitudinal and of the shear part with depth [1/m]; c_l^2 / c_t^2 = 3.
local fall, shear_fall = k * math.sqrt(1 - ratio ^ 2 / 3), k * math.sqrt(1 - ratio ^ 2)

-- Displacements along and across the surface, and the trace of the strain, at a height z < 0.
local function profile(z)
  local long, shear = math.exp(fall * z), math.exp(shear_fall * z)
  local sum = k ^ 2 + shear_fall ^ 2
  local along = long - 2 * fall * shear_fall / sum * shear
  local across = fall / k * (long - 2 * k ^ 2 / sum * shear)
  local slope = fall / k * (fall * long - 2 * k ^ 2 * shear_fall / sum * shear)
  return along, across, slope - k * along
end

-- The packet, which moves along +x, at the time 0.
local function packet(model, thickness)
  local state, narrowing = {x = {}, v = {}}, material.poisson / (1 - material.poisson)
  for i, node in ipairs(model:nodes()) do
    local along, across, trace = profile(node.z)
    local size = amplitude / k * math.exp(-((node.x - length / 2 + travel / 2) / width) ^ 2)
    local c, sine = size * math.cos(k * node.x), size * math.sin(k * node.x)
    local thin = -narrowing * trace * (node.y - thickness / 2)
    state.x[i] = {node.x + along * c, node.y + thin * sine, node.z + across * sine}
    state.v[i] = {omega * along * sine, -omega * thin * c, -omega * across * c}
  end
  return state
end

-- Phase of the part of the displacements that the wave makes up [rad].
local function phase(model, state)
  local real, imaginary = 0, 0
  for i, node in ipairs(model:nodes()) do
    local along, across = profile(node.z)
    local c, sine = math.cos(k * node.x), math.sin(k * node.x)
    local u, w = state.x[i][1] - node.x, state.x[i][3] - node.z
    -- (u X + i w Z) exp(-i k x)
    real = real + node.mass * (u * along * c + w * across * sine)
    imaginary = imaginary + node.mass * (w * across * c - u * along * sine)
  end
  return math.atan(imaginary, real)
end

return {
  name = "rayleigh",
  title = "Rayleigh wave",
  text = "A packet of surface waves runs along the edge of a sheet one cell thick, of nu = 1/3: in "
    .. "plane stress, these are the waves of a half space of nu = 1/4. Its speed is that of the "
    .. "phase at the wavelength, while it moves on by one wavelength.",
  source = "Rayleigh 1885; the quantity is c / c_t.",
  size_name = "cells a wavelength", sizes = {8, 16, 32}, quick = {6, 12},
  quantities = {{name = "c / c_t", reference = ratio, goal = 1}},
  body = function(cells)
    return s.lattice(s.grid{
      cell = 1 / cells, size = {length * cells, 1, math.floor(depth * cells)},
      origin = {0, 0, -math.floor(depth * cells) / cells},
      materials = {sheet = material}, fill = function() return "sheet" end,
    })
  end,
  measure = function(model, cells)
    local duration = travel / (ratio * shear_speed)
    local start = packet(model, 1 / cells)
    local run = s.run(model, {gravity = {0, 0, 0}, duration = duration},
      {start = start, frame_rate = 0, quiet = true})
    -- One whole turn, and what the phase lacks of it.
    local turned = 2 * math.pi - (phase(model, run.final) - phase(model, start))
    return {turned / (k * duration * shear_speed)}
  end,
}
