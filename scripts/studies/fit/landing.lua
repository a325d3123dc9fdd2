-- Landings: a body thrown at a floor with friction, its levels compared with it frame by frame.

local s = require "springlod"

local landing = {}

local speed = 3 -- towards the floor [m/s]
local slide = 1 -- along it [m/s]
local spin = {4, -3, 2} -- [rad/s]
local friction = 0.5
local gap = 0.02 -- from the floor at the start, over the diagonal of the body
local frame_rate = 400 -- [1/s]
-- Times after the first contact of the base between which errors are averaged [s].
local windows = {early = {0, 0.05}, late = {0.05, 0.2}}

-- Directions spread evenly over the sphere (a spiral with the golden angle).
local function directions(count)
  local list, golden = {}, math.pi * (3 - math.sqrt(5))
  for i = 1, count do
    local z = 1 - (2 * i - 1) / count
    local radius, angle = math.sqrt(1 - z * z), golden * i
    list[i] = {radius * math.cos(angle), radius * math.sin(angle), z}
  end
  return list
end

local function dot(a, b) return a[1] * b[1] + a[2] * b[2] + a[3] * b[3] end

local function scaled(factor, v) return {factor * v[1], factor * v[2], factor * v[3]} end

-- A unit vector across `up`.
local function across(up)
  local axis = math.abs(up[1]) < 0.6 and {1, 0, 0} or {0, 1, 0}
  local part = dot(axis, up)
  local v = {axis[1] - part * up[1], axis[2] - part * up[2], axis[3] - part * up[3]}
  return scaled(1 / math.sqrt(dot(v, v)), v)
end

-- The body stays as it is, and the floor comes from any direction.
local function scene_of(base, up)
  local lowest = math.huge
  for _, node in ipairs(base:nodes()) do
    lowest = math.min(lowest, dot(up, {node.x, node.y, node.z}))
  end
  local distance, sideways = gap * base.bounds.diagonal, across(up)
  local velocity = {}
  for d = 1, 3 do velocity[d] = slide * sideways[d] - speed * up[d] end
  return s.scenario{
    gravity = scaled(-9.81, up), duration = distance / speed + windows.late[2] + 0.01,
    throw = {velocity = velocity, spin = spin},
    obstacles = {{plane = {up[1], up[2], up[3], lowest - distance}, friction = friction}},
  }
end

local function run(model, scene, more)
  local options = {contact = "surface", frame_rate = frame_rate, ledger = false, quiet = true}
  for name, value in pairs(more or {}) do options[name] = value end
  return s.run(model, scene, options)
end

-- Root mean squares over the windows of the distance of a run from the base's, over the diagonal of
-- the body [1].
local function errors(found, of_base, diagonal)
  local result = {}
  for name, window in pairs(windows) do
    local sum, count = 0, 0
    for _, frame in ipairs(s.deviation(found, of_base)) do
      local time = frame.time - of_base.first_contact
      if time >= window[1] and time <= window[2] then
        sum, count = sum + frame.surface ^ 2, count + 1
      end
    end
    result[name] = math.sqrt(sum / count) / diagonal
  end
  return result
end

local function mean(list)
  local result = {}
  for name in pairs(windows) do
    result[name] = 0
    for _, one in ipairs(list) do result[name] = result[name] + one[name] / #list end
  end
  return result
end

-- Runs of the base from `count` directions, and `noise`: the errors of the same runs with half the
-- step.
function landing.of_base(base, count)
  local landings, noise = {diagonal = base.bounds.diagonal}, {}
  for i, up in ipairs(directions(count)) do
    local scene = scene_of(base, up)
    local of_base = run(base, scene)
    landings[i] = {scene = scene, run = of_base}
    noise[i] = errors(run(base, scene, {step = of_base.step / 2}), of_base, landings.diagonal)
  end
  landings.noise = mean(noise)
  return landings
end

-- Mean errors of a level of that base over these landings [1]: early, in the first 50 ms after the
-- first contact, and late, up to 200 ms after it.
function landing.errors(level, landings)
  local list = {}
  for i, one in ipairs(landings) do
    list[i] = errors(run(level, one.scene), one.run, landings.diagonal)
  end
  return mean(list)
end

return landing
