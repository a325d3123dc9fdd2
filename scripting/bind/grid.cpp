// Grids of cells: from a function of the script, and as .vdb files.

#include "voxelize/grid.hpp"

#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>

#include <fmt/format.h>
#include <lua.hpp>

#include "base/error.hpp"
#include "base/units.hpp"
#include "scripting/bind/tables/records.hpp"
#include "scripting/bind/tables/values.hpp"
#include "scripting/bind/topics.hpp"
#include "scripting/engine/call.hpp"
#include "voxelize/cells/separate.hpp"
#include "voxelize/vdb_file.hpp"

namespace springlod::scripting {

namespace {

constexpr const char* kGroup = "From mesh to model";

Box3 grid_box(const voxelize::MaterialGrid& grid) {
  Box3 box;
  for (const voxelize::CellIndex& cell : grid.cells) {
    const Vec3 corner = grid.origin + grid.cell * Vec3(cell[0], cell[1], cell[2]);
    box.extend(corner);
    box.extend(corner + Vec3::Constant(grid.cell));
  }
  return box;
}

using MaterialNumbers = std::map<std::string, std::uint16_t>;

// Result of `fill` for the cell with that centre: a material's number, or none for an empty cell.
std::optional<std::uint16_t> filling(lua_State* L, int fill, const Vec3& center,
                                     const MaterialNumbers& numbers) {
  lua_pushvalue(L, fill);
  for (int axis = 0; axis < 3; ++axis) push(L, center[axis]);
  lua_call(L, 3, 1);
  if (lua_isnil(L, -1)) {
    lua_pop(L, 1);
    return std::nullopt;
  }
  if (lua_type(L, -1) != LUA_TSTRING)
    throw InputError(
        fmt::format("grid: fill must return the name of a material, or nothing for an empty cell; "
                    "at ({:.4g}, {:.4g}, {:.4g}) m it returned {}",
                    center.x(), center.y(), center.z(), describe_type_at(L, -1)));
  const std::string name = lua_tostring(L, -1);
  lua_pop(L, 1);
  const auto found = numbers.find(name);
  if (found == numbers.end())
    throw InputError(fmt::format("grid: fill returned '{}', which materials does not name", name));
  return found->second;
}

voxelize::CellIndex read_size(TableReader& reader) {
  // Calls of `fill`: seconds.
  constexpr lua_Integer kMost = 10'000'000;
  const int given = reader.raw("size");
  lua_State* L = reader.lua();
  voxelize::CellIndex size{};
  for (int axis = 0; axis < 3; ++axis) {
    const bool here =
        given != 0 && lua_istable(L, given) && lua_rawgeti(L, given, axis + 1) == LUA_TNUMBER;
    const lua_Integer count = here && lua_isinteger(L, -1) != 0 ? lua_tointeger(L, -1) : 0;
    if (count < 1 || count > kMost)
      reader.refuse("size", fmt::format("a list of three counts of cells, each 1 to {}", kMost));
    size[static_cast<std::size_t>(axis)] = static_cast<std::int32_t>(count);
    lua_pop(L, 1);
  }
  if (1.0 * size[0] * size[1] * size[2] > kMost)
    reader.refuse("size",
                  fmt::format("three counts of cells, together at most {}; {} x {} x {} "
                              "make {:.2g}",
                              kMost, size[0], size[1], size[2], 1.0 * size[0] * size[1] * size[2]));
  return size;
}

void fill_cells(lua_State* L, int fill, const voxelize::CellIndex& size,
                const MaterialNumbers& numbers, voxelize::MaterialGrid& grid) {
  voxelize::CellIndex cell{};
  for (cell[2] = 0; cell[2] < size[2]; ++cell[2])
    for (cell[1] = 0; cell[1] < size[1]; ++cell[1])
      for (cell[0] = 0; cell[0] < size[0]; ++cell[0]) {
        const auto material = filling(L, fill, grid.center(cell), numbers);
        if (!material) continue;
        grid.cells.push_back(cell);
        grid.material.push_back(*material);
      }
  if (grid.cells.empty())
    throw InputError(fmt::format("grid: fill left all of the {} x {} x {} cells empty", size[0],
                                 size[1], size[2]));
}

int grid_binding(Call& call) {
  auto value = std::make_shared<GridValue>();
  voxelize::MaterialGrid& grid = value->grid;
  TableReader reader = call.options(1);
  reader.read("cell", grid.cell);
  if (!reader.has("cell")) reader.refuse("cell", "given: the edge of a cell");
  const voxelize::CellIndex size = read_size(reader);
  reader.read("origin", grid.origin);
  const int materials = reader.raw("materials");
  if (materials == 0)
    reader.refuse("materials", "given, as in materials = {a = {young = \"1 MPa\"}}");
  MaterialNumbers numbers;
  std::vector<MaterialInput> inputs;
  for (const auto& [name, input] : read_materials(call, materials, "grid")) {
    numbers[name] = static_cast<std::uint16_t>(inputs.size());
    inputs.push_back(input);
  }
  const int fill = reader.raw("fill");
  if (fill == 0 || !lua_isfunction(call.lua(), fill))
    reader.refuse("fill", "a function of the centre of a cell");
  if (const int mesh = reader.raw("surface")) {
    value->mesh = std::static_pointer_cast<const MeshValue>(
        boxed_at(call.lua(), mesh, &kValueName<MeshValue>));
    if (!value->mesh) reader.refuse("surface", "a Mesh");
    value->provenance = value->mesh->provenance;
  }
  reader.finish();
  fill_cells(call.lua(), fill, size, numbers, grid);
  set_materials(grid, inputs);
  value->provenance.set("springlod", version());
  value->provenance.set("grid", "cells of a script");
  value->provenance.set("cell", fmt::format("{} m", grid.cell));
  return call.give(std::shared_ptr<const GridValue>(value));
}

int save_vdb_binding(Call& call) {
  voxelize::save_vdb(with_depth(*call.value<GridValue>(2)), call.writable(1));
  return 0;
}

int load_vdb_binding(Call& call) {
  auto value = std::make_shared<GridValue>();
  value->grid = voxelize::load_vdb(call.readable(1));
  value->provenance.set("springlod", version());
  value->provenance.set("grid", call.readable(1).filename().string());
  return call.give(std::shared_ptr<const GridValue>(value));
}

std::string grid_text(const GridValue& value) {
  std::vector<std::size_t> counts(value.grid.materials.size(), 0);
  for (const std::uint16_t material : value.grid.material) ++counts[material];
  std::string text = fmt::format("Grid: {} cells of {}", value.grid.cells.size(),
                                 format_quantity(value.grid.cell, Dimension::length));
  for (std::size_t i = 0; i < counts.size(); ++i)
    if (counts[i] > 0) text += fmt::format(", {} {}", counts[i], value.grid.materials[i].name);
  return text;
}

void describe_grid_type(Api& api) {
  TypeBuilder<GridValue> type("Filled cells of a cubic grid, each of one material.", grid_text);
  type.field("cell", "number", "edge of a cell [m]",
             [](const GridValue& value) { return value.grid.cell; });
  type.field("cell_count", "integer", "number of filled cells",
             [](const GridValue& value) { return value.grid.cells.size(); });
  type.field("body_count", "integer", "number of bodies that do not touch, not even at a corner",
             [](const GridValue& value) { return voxelize::count_bodies(value.grid); });
  type.field("volume", "number", "volume of the filled cells, cut ones by their fractions [m3]",
             [](const GridValue& value) { return volume(value.grid); });
  type.field("surface_point_count", "integer",
             "points of its surface, where a lattice on cut cells touches obstacles; 0 without cut "
             "cells",
             [](const GridValue& value) { return value.grid.surface.size(); });
  type.field("min", "{x, y, z}", "lowest corner of the filled cells [m]",
             [](const GridValue& value) { return Vec3(grid_box(value.grid).min()); });
  type.field("max", "{x, y, z}", "highest corner of the filled cells [m]",
             [](const GridValue& value) { return Vec3(grid_box(value.grid).max()); });
  type.table_field(
      "materials", "list of Material", "materials by number",
      [](lua_State* L, const GridValue& value) { push_materials(L, value.grid.materials); });
  type.table_field("cells", "list of {x, y, z, depth=, material=, fraction=}",
                   "centre [m], depth under the surface [m] and material's name of every cell, and "
                   "the fraction of a cut cell that is inside",
                   [](lua_State* L, const GridValue& value) {
                     const voxelize::MaterialGrid grid = with_depth(value);
                     begin_list(L, grid.cells.size());
                     for (std::size_t i = 0; i < grid.cells.size(); ++i) {
                       push(L, grid.center(grid.cells[i]));
                       if (i < grid.depth.size())
                         set_field(L, "depth", static_cast<double>(grid.depth[i]));
                       set_field(L, "material", grid.materials[grid.material[i]].name);
                       if (!grid.fraction.empty())
                         set_field(L, "fraction", static_cast<double>(grid.fraction[i]));
                       end_list_entry(L, i + 1);
                     }
                   });
  api.add(type.build());
}

}  // namespace

void describe_grid(Api& api) {
  describe_grid_type(api);
  api.add(FunctionEntry{
      .name = "grid",
      .group = kGroup,
      .summary =
          "Makes a grid without a mesh, from a function that returns the material of each cell.",
      .options =
          {{.name = "cell",
            .type = "quantity",
            .dimension = Dimension::length,
            .range = Range{1e-9, 1e6},
            .help = "edge of a cell"},
           {.name = "size", .type = "{nx, ny, nz}", .help = "cells along each axis"},
           {.name = "origin",
            .type = "{x, y, z} in m",
            .dimension = Dimension::length,
            .fallback = "{0, 0, 0}",
            .help = "lowest corner of the first cell"},
           {.name = "materials", .type = "table of Material by name", .help = "materials by name"},
           {.name = "fill",
            .type = "function(x, y, z) -> name",
            .help = "called for each cell with its centre [m]; returns the name of one of the "
                    "materials, or nothing for an empty cell"},
           {.name = "surface",
            .type = "Mesh",
            .fallback = "none",
            .help = "surface drawn instead of the cells; it follows the nodes near it"}},
      .returns = "Grid",
      .errors = "No cell is filled; a name is not in materials.",
      .example = "local bar = s.grid{cell = \"10 cm\", size = {4, 4, 20},\n"
                 "  materials = {stiff = {young = \"1 MPa\"}, soft = {young = \"0.1 MPa\"}},\n"
                 "  fill = function(x, y, z) return z < 1 and \"stiff\" or \"soft\" end}",
      .call = grid_binding});
  api.add(FunctionEntry{
      .name = "save_vdb",
      .group = kGroup,
      .summary = "Writes a grid as .vdb: distance, material number, Young's modulus, density.",
      .arguments = {{.name = "path", .type = "string", .help = "file to write"},
                    {.name = "grid", .type = "Grid", .help = "grid to write"}},
      .returns = "nothing",
      .errors = "The file cannot be written.",
      .example = "s.save_vdb(\"out/dumbbell.vdb\", grid)",
      .call = save_vdb_binding});
  api.add(
      FunctionEntry{.name = "load_vdb",
                    .group = kGroup,
                    .summary = "Reads a grid that save_vdb wrote.",
                    .arguments = {{.name = "path", .type = "string", .help = "file to read"}},
                    .returns = "Grid: without a mesh",
                    .errors = "No such file, not a .vdb file, or one that save_vdb did not write.",
                    .example = "local grid = s.load_vdb(\"out/dumbbell.vdb\")",
                    .call = load_vdb_binding});
}

}  // namespace springlod::scripting
