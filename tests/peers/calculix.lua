-- References by CalculiX (Debian's package calculix-ccx) for scripts/studies/validate:
-- two_materials.lua, plates.lua, silicone.lua and hertz.lua.
--   springlod --unsafe run tests/peers/calculix.lua [-- FOLDER [WORDS]]
-- WORDS: any of frequencies, loads, plates, silicone, ball.
local deck = require "calculix.deck"
local free_loads = require "calculix.free_loads"
local pressed_ball = require "calculix.pressed_ball"
local finite_ball = require "studies.validate.finite_ball"
local smooth_loads = require "studies.validate.smooth_loads"
local two_materials = require "studies.validate.two_material_block"
local pad = require "studies.validate.pad"
local silicone_beam = require "studies.validate.silicone_beam"

local folder = arg[1] or "out/calculix"
local zero_modes, modes = 6, 10

local function two_material_block(kind, poisson)
  return {size = two_materials.size, young = two_materials.young, poisson = poisson, kind = kind,
          density = two_materials.density, material_at = two_materials.material_at}
end

-- Calls work(kind, poisson, cells, name of a job) for meshes of the two-material block.
local function each_two_material_mesh(cells_of, work)
  for _, poisson in ipairs(two_materials.ratios) do
    for _, kind in ipairs{"C3D8", "C3D20"} do
      for _, cells in ipairs(cells_of[kind]) do
        work(kind, poisson, cells, ("%s_%d_%g"):format(kind, cells, poisson))
      end
    end
  end
end

local function say(kind, poisson, cells, values, format)
  for i, value in ipairs(values) do values[i] = format:format(value) end
  print(("two materials, nu = %g, %d cells per metre, %s: %s"):format(poisson, cells, kind,
    table.concat(values, ", ")))
  io.stdout:flush()
end

local function frequencies()
  each_two_material_mesh({C3D8 = {4, 8, 16}, C3D20 = {4, 8}}, function(kind, poisson, cells, name)
    local mesh = deck.mesh(two_material_block(kind, poisson), cells)
    say(kind, poisson, cells,
      deck.frequencies(folder, "modes_" .. name, mesh.lines, zero_modes, modes), "%.5f")
  end)
end

-- Compliances under the nine smooth loads of 1 N.
local function loads()
  local fields = {}
  for i, load in ipairs(smooth_loads.list) do
    local sum = smooth_loads.sum(load.field, two_materials.size)
    fields[i] = function(...)
      local f = load.field(...)
      return {f[1] / sum, f[2] / sum, f[3] / sum}
    end
  end
  each_two_material_mesh({C3D8 = {4, 8, 16}, C3D20 = {4, 8, 12, 16}},
    function(kind, poisson, cells, name)
      say(kind, poisson, cells, free_loads.compliances(folder, "loads_" .. name,
        two_material_block(kind, poisson), cells, fields), "%.6e")
    end)
end

-- The force that presses the pad, over young * strain * area.
local function pressed(cells, poisson)
  local mesh = deck.mesh({size = pad.size, young = {pad = pad.young}, poisson = poisson,
                          density = 1, material_at = function() return "pad" end}, cells)
  local lines = mesh.lines
  deck.add_set(mesh, "LOW", function(_, _, z) return z == 0 end)
  deck.add_set(mesh, "HIGH", function(_, _, z) return z == pad.size[3] end)
  lines[#lines + 1] = ("*STEP\n*STATIC\n*BOUNDARY\nLOW, 1, 3\nHIGH, 1, 2\nHIGH, 3, 3, %g"):format(
    -pad.press * pad.size[3])
  lines[#lines + 1] = "*NODE PRINT, NSET=HIGH, TOTALS=ONLY\nRF\n*END STEP"
  for line in deck.results(folder, ("pad_%d_%g"):format(cells, poisson), lines) do
    local force = line:match("^%s*%S+E%S+%s+%S+E%S+%s+(%S+E%S+)%s*$")
    if force then
      return -tonumber(force) / (pad.young * pad.press * pad.size[1] * pad.size[2])
    end
  end
end

local function plates()
  for _, poisson in ipairs(pad.ratios) do
    for _, cells in ipairs{8, 16, 24} do
      print(("plates, nu = %g, %d cells per metre: %.5f"):format(poisson, cells,
        pressed(cells, poisson)))
    end
  end
end

-- The lowest frequency of the beam, clamped at one end.
local function silicone()
  local beam = silicone_beam
  for _, across in ipairs{3, 6, 9} do
    local mesh = deck.mesh({size = {beam.length, beam.height, beam.height},
                            young = {silicone = beam.young}, poisson = beam.poisson,
                            density = beam.density,
                            material_at = function() return "silicone" end}, across / beam.height)
    deck.add_set(mesh, "CLAMP", function(x) return x == 0 end)
    mesh.lines[#mesh.lines + 1] = "*BOUNDARY\nCLAMP, 1, 3"
    print(("silicone, %d cells across: %.5f"):format(across,
      deck.frequencies(folder, "silicone_" .. across, mesh.lines, 0, 1)[1]))
  end
end

-- The depth of a pressed ball over that of the series, for three materials of nu = 1/4.
local function ball()
  local materials = {
    {name = "small strain", lines = "*ELASTIC\n1, 0.25"},
    {name = "Saint Venant-Kirchhoff", lines = "*ELASTIC\n1, 0.25", large = true},
    {name = "neo-Hookean", lines = "*HYPERELASTIC, NEO HOOKE\n0.2, 3", large = true},
  }
  for _, angle in ipairs{0.1, 0.1838, 0.3} do
    local depth, force = finite_ball.at_angle(angle)
    for i, material in ipairs(materials) do
      local found = pressed_ball.depth(folder, ("ball_%g_%d"):format(angle, i), angle, force,
        material.lines, material.large)
      print(("ball, depth %.4f, %s: %.5f times as deep, %.4f times the force at that depth"):format(
        depth, material.name, found / depth, force / finite_ball.force(found)))
    end
  end
end

local tasks = {frequencies = frequencies, loads = loads, plates = plates, silicone = silicone,
               ball = ball}
local words = {table.unpack(arg, 2)}
if #words == 0 then words = {"frequencies", "loads", "plates", "silicone", "ball"} end
os.execute(("mkdir -p '%s'"):format(folder))
for _, word in ipairs(words) do tasks[word]() end
