-- Writes the first inputs of the fuzz targets, which the quick mutation runs damage too:
--   springlod run tests/fuzz/make_corpus.lua -- tests/fuzz/corpus
-- Small bodies, so that a run of an input takes a millisecond.

local s = require "springlod"
local folder = (...) or error("name the folder to write to")

local materials = {
  rubber = {young = "1 MPa", density = 1100, damping = 0.004, colour = {0.9, 0.2, 0.1}},
  steel = {young = "10 MPa", density = 7800},
  gel = {young = "0.1 MPa", density = 1000, damping = 0.004, poisson = 0.45},
}

-- A box of whole cells, as a mesh file.
local function box(nx, ny, nz, cell)
  local lines, at = {"o box"}, {[0] = 0, 1}
  for corner = 0, 7 do
    lines[#lines + 1] = ("v %g %g %g"):format(at[corner & 1] * nx * cell,
                                              at[corner >> 1 & 1] * ny * cell,
                                              at[corner >> 2] * nz * cell)
  end
  for _, face in ipairs{"1 3 4 2", "5 6 8 7", "1 2 6 5", "3 7 8 4", "1 5 7 3", "2 4 8 6"} do
    lines[#lines + 1] = "f " .. face
  end
  return table.concat(lines, "\n") .. "\n"
end

local function grid(size, fill, surface)
  return s.grid{cell = 0.1, size = size, materials = materials, fill = fill, surface = surface}
end

local function two_materials(x) return x < 0.1 and "rubber" or "steel" end
local function rubber() return "rubber" end
local function gel() return "gel" end

local mesh_path = folder .. "/mesh/box.obj"
s.save_text(mesh_path, box(2, 1, 1, 0.1))
local surface = s.import(mesh_path, {unit = "m"})

local bars = {
  two_materials = grid({2, 1, 1}, two_materials, surface),
  one_cell = grid({1, 1, 1}, rubber),
  dilatation = grid({2, 2, 1}, gel),
}
for name, bar in pairs(bars) do
  local chain = s.simplify(s.lattice(bar), {levels = 1})
  s.save(("%s/asset/%s.glb"):format(folder, name), chain)
  s.save_vdb(("%s/vdb/%s.vdb"):format(folder, name), bar)
end
s.save_text(folder .. "/materials/two.lua", [[
return {rubber = {young = "1 MPa", density = 1100, damping = 0.004, colour = {0.9, 0.2, 0.1}},
        steel = {young = 1e7, density = 7800, damping = "2 ms", poisson = 0.3}}
]])
s.save_text(folder .. "/materials/computed.lua", [[
local materials = {}
for _, name in ipairs{"rubber", "steel"} do
  local soft = name:find("^rub") ~= nil
  materials[name] = {young = (soft and 1 or 10) * 1e6, density = math.max(1000, 2 ^ 10),
                     damping_ratio = soft and 0.05 or nil}
end
return setmetatable(materials, {__index = function() return {young = "2 MPa"} end})
]])
local certified = s.simplify(s.lattice(grid({2, 2, 1}, rubber)), {levels = 1, calibrate = "moduli"})
s.save(folder .. "/asset/certified.glb", s.certify(certified))
