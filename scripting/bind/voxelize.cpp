// Meshes, their voxelizing, and the lattices built on grids.

#include <utility>

#include <fmt/format.h>
#include <lua.hpp>

#include "base/error.hpp"
#include "base/message.hpp"
#include "base/units.hpp"
#include "scripting/bind/tables/options.hpp"
#include "scripting/bind/tables/records.hpp"
#include "scripting/bind/tables/values.hpp"
#include "scripting/bind/topics.hpp"
#include "scripting/engine/call.hpp"
#include "scripting/engine/result_table.hpp"
#include "voxelize/grid.hpp"
#include "voxelize/lattice/lattice.hpp"
#include "voxelize/mesh/import.hpp"
#include "voxelize/mesh/repair.hpp"

namespace springlod::scripting {

namespace {

constexpr const char* kGroup = "From mesh to model";

std::string box_text(const Box3& box) {
  const Vec3 size = box.sizes();
  return fmt::format("{} x {} x {}", format_quantity(size.x(), Dimension::length),
                     format_quantity(size.y(), Dimension::length),
                     format_quantity(size.z(), Dimension::length));
}

int import_binding(Call& call) {
  voxelize::ImportOptions options;
  TableReader reader = call.options(2);
  std::string unit;
  reader.read("unit", unit);
  if (!unit.empty()) options.unit = length_unit(unit);
  voxelize::UpAxis up = voxelize::UpAxis::z;
  reader.read("up", up);
  if (reader.has("up")) options.up = up;
  reader.finish();
  options.progress = call.progress();

  const std::filesystem::path path = call.readable(1);
  auto value = std::make_shared<MeshValue>();
  voxelize::ImportedMesh imported = voxelize::import_mesh(path, options);
  value->mesh = std::move(imported.mesh);
  value->report = imported.report;
  value->provenance.set("springlod", version());
  value->provenance.set("mesh", path.filename().string());
  value->provenance.set("mesh_hash", imported.report.content_hash);
  value->provenance.set("unit", fmt::format("{} m", imported.report.unit));
  std::string remarks = voxelize::describe(imported.report);
  while (remarks.ends_with('\n')) remarks.pop_back();
  if (!remarks.empty()) call.session().console().say(remarks);
  return call.give(std::shared_ptr<const MeshValue>(value));
}

void read_core(Call& call, TableReader& reader, voxelize::VoxelizeOptions& options) {
  const int table = reader.raw("core");
  if (table == 0) return;
  TableReader core = call.record(table, "Core", "voxelize: core");
  voxelize::VoxelizeOptions::CoreShell core_shell;
  core.read("depth", core_shell.core_depth);
  if (!core.has("depth")) core.refuse("depth", "given: how deep under the surface the core begins");
  const int material = core.raw("material");
  if (material == 0) core.refuse("material", "given: a Material table");
  core_shell.core = read_material(call, material, "voxelize: core.material", "core");
  core.finish();
  options.core_shell = core_shell;
}

voxelize::PaintFunction paint_function(lua_State* L, int function) {
  return [L, function](const Vec3& center, double depth, const std::string& material) {
    lua_pushvalue(L, function);
    for (int axis = 0; axis < 3; ++axis) push(L, center[axis]);
    push(L, depth);
    push(L, material);
    lua_call(L, 5, 1);
    if (!lua_isnil(L, -1) && lua_type(L, -1) != LUA_TSTRING)
      throw InputError(
          fmt::format("voxelize: paint must return the name of a material or nothing, got {}",
                      describe_type_at(L, -1)));
    std::string name = lua_isnil(L, -1) ? "" : lua_tostring(L, -1);
    lua_pop(L, 1);
    return name;
  };
}

int voxelize_binding(Call& call) {
  const auto mesh = call.value<MeshValue>(1);
  voxelize::VoxelizeOptions options;
  TableReader reader = call.options(2);
  reader.read("cell", options.cell);
  if (const int table = reader.raw("materials"))
    options.materials = read_materials(call, table, "voxelize");
  if (const int table = reader.raw("fallback"))
    options.fallback =
        read_material(call, table, "voxelize: fallback", options.fallback.material.name);
  reader.read("priority", options.priority);
  read_core(call, reader, options);
  if (const int function = reader.raw("paint")) {
    if (!lua_isfunction(call.lua(), function)) reader.refuse("paint", "a function");
    options.paint = paint_function(call.lua(), function);
  }
  reader.read("repair", options.repair);
  reader.read("cut_cells", options.cut_cells);
  reader.read("for_lattice", options.for_lattice);
  reader.finish();
  options.threads = call.session().settings().threads;
  options.progress = call.progress();

  voxelize::VoxelizedMesh result = voxelize::voxelize(mesh->mesh, options);
  for (const auto* lines : {&result.report.repairs, &result.report.warnings})
    for (const std::string& line : *lines) call.session().console().say(line);
  if (result.report.cell_chosen)
    call.session().console().say(
        fmt::format("cells of {} (longest side / 32; the option cell changes it)",
                    format_quantity(result.report.cell, Dimension::length)));
  auto value = std::make_shared<GridValue>();
  value->grid = std::move(result.grid);
  value->mesh = mesh;
  if (result.repaired) {
    auto repaired = std::make_shared<MeshValue>(*mesh);
    repaired->mesh = std::move(*result.repaired);
    value->mesh = repaired;
  }
  value->voxelized = true;
  value->provenance = mesh->provenance;
  value->provenance.set("cell", fmt::format("{} m", value->grid.cell));
  if (options.cut_cells) value->provenance.set("cut cells", "true");
  if (!result.report.repairs.empty())
    value->provenance.set("repair", fmt::format("{}", fmt::join(result.report.repairs, "; ")));
  return call.give(std::shared_ptr<const GridValue>(value));
}

void say_hinges(Call& call, const voxelize::LatticeModel& lattice, voxelize::HingePolicy policy) {
  if (lattice.hinges.empty()) return;
  const Vec3& at = lattice.hinges.front().position;
  const std::string what = fmt::format(
      "{} where cells touch only along an edge or at a corner, the first at "
      "({:.4g}, {:.4g}, {:.4g}) m",
      counted(lattice.hinges.size(), "hinge"), at.x(), at.y(), at.z());
  if (policy == voxelize::HingePolicy::report)
    call.session().console().say(what + "; hinges = \"fill\" or \"separate\" removes them");
  if (policy == voxelize::HingePolicy::fill)
    call.session().console().say(
        fmt::format("{}: mended by {}", what, counted(lattice.filled_cells, "more cell")));
  if (policy == voxelize::HingePolicy::separate)
    call.session().console().say(
        fmt::format("{}: the cells were taken apart, {} parts", what, lattice.components));
}

int lattice_binding(Call& call) {
  const auto grid = call.value<GridValue>(1);
  voxelize::LatticeOptions options;
  TableReader reader = call.options(2);
  read_options(call, reader, options);
  reader.finish();

  voxelize::LatticeModel lattice = voxelize::build_lattice(grid->grid, options);
  say_hinges(call, lattice, options.hinges);
  const std::string style =
      options.style == voxelize::LatticeStyle::corners ? "corners" : "centers";
  auto value = std::make_shared<ModelValue>();
  value->model = std::make_shared<const MassSpringModel>(std::move(lattice.model));
  value->made_by = "lattice " + style;
  value->provenance = grid->provenance;
  value->provenance.set("lattice", style);
  if (!options.volumes) value->provenance.set("volumes", "false");
  if (grid->mesh) {
    value->surface = std::shared_ptr<const TriangleMesh>(grid->mesh, &grid->mesh->mesh);
    value->surface_of_base =
        std::make_shared<const Binding>(bind_points(value->surface->positions, *value->model));
  }
  return call.give(std::shared_ptr<const ModelValue>(value));
}

Words length_units() {
  Words words{"unit"};
  for (const std::string& unit : unit_names(Dimension::length)) words.all.push_back({unit});
  return words;
}

void describe_mesh(Api& api) {
  TypeBuilder<MeshValue> type(
      "A surface of triangles in metres, z up, in named parts.", [](const MeshValue& value) {
        return fmt::format("Mesh: {} vertices, {} triangles, {}, {}", value.mesh.positions.size(),
                           value.mesh.triangles.size(), counted(value.mesh.parts.size(), "part"),
                           box_text(bounds(value.mesh)));
      });
  type.field("vertex_count", "integer", "number of vertices",
             [](const MeshValue& value) { return value.mesh.positions.size(); });
  type.field("triangle_count", "integer", "number of triangles",
             [](const MeshValue& value) { return value.mesh.triangles.size(); });
  type.table_field("parts", "list of {name, material, triangle_count, volume}",
                   "named objects of the file, volume in m3",
                   [](lua_State* L, const MeshValue& value) {
                     begin_list(L, value.mesh.parts.size());
                     std::size_t number = 0;
                     for (const MeshPart& part : value.mesh.parts) {
                       begin_table(L);
                       set_field(L, "name", part.name);
                       set_field(L, "material", part.material);
                       set_field(L, "triangle_count", part.triangle_count);
                       set_field(L, "volume", signed_volume(value.mesh, part));
                       end_list_entry(L, ++number);
                     }
                   });
  type.table_field(
      "solids", "list of MeshSolid", "its solids, and their faults: what voxelize would repair",
      [](lua_State* L, const MeshValue& value) {
        push_tables(L, voxelize::find_faults(value.mesh), [L](const voxelize::SolidRepair& solid) {
          set_field(L, "part", solid.part);
          set_field(L, "volume", solid.volume);
          set_field(L, "thickness", solid.thickness);
          set_field(L, "holes", solid.holes);
          set_field(L, "open_edges", solid.open_edges);
          set_field(L, "hole_area", solid.hole_area);
          set_field(L, "turned", solid.turned);
          set_field(L, "doubled", solid.doubled);
          set_field(L, "crossing_edges", solid.crossing_edges);
          set_field(L, "faults", voxelize::describe(solid));
        });
      });
  type.field("min", "{x, y, z}", "lowest corner of the bounding box [m]",
             [](const MeshValue& value) { return Vec3(bounds(value.mesh).min()); });
  type.field("max", "{x, y, z}", "highest corner of the bounding box [m]",
             [](const MeshValue& value) { return Vec3(bounds(value.mesh).max()); });
  type.field("positions", "list of {x, y, z}", "vertices [m]",
             [](const MeshValue& value) { return value.mesh.positions; });
  type.field("unit", "number", "metres in one unit of the file",
             [](const MeshValue& value) { return value.report.unit; });
  type.field("unit_assumed", "boolean", "whether neither the file nor the call stated the unit",
             [](const MeshValue& value) { return value.report.unit_assumed; });
  type.field("format", "string", "format of the file, such as \"OBJ\"",
             [](const MeshValue& value) { return value.report.format; });
  api.add(type.build());
}

void describe_solid(Api& api) {
  api.add(RecordEntry{
      .name = "MeshSolid",
      .summary = "A solid of a mesh: parts of one name, or open parts that have edges in common.",
      .fields = {result_field("part", "string", "name of its first part"),
                 result_field("volume", "number", "with each hole closed [m3]"),
                 result_field(
                     "thickness", "number",
                     "median distance from its surface to the other side [m]: the wall of a "
                     "hollow body, the width of a bar, the diameter of a rod"),
                 result_field("holes", "integer", "connected groups of open edges"),
                 result_field("open_edges", "integer", "edges with one triangle"),
                 result_field("hole_area", "number", "area of the holes [m2]"),
                 result_field("turned", "integer", "triangles that face against their neighbours"),
                 result_field("doubled", "integer", "triangles with the corners of another one"),
                 result_field("crossing_edges", "integer", "edges with more than two triangles"),
                 result_field("faults", "list of strings", "the same in words")},
      .example = "for _, solid in ipairs(mesh.solids) do print(solid.part, solid.holes) end"});
}

void describe_voxelize_function(Api& api) {
  api.add(RecordEntry{
      .name = "Core",
      .summary = "A core of another material under a shell, for voxelize.",
      .fields = {{.name = "depth",
                  .type = "quantity",
                  .dimension = Dimension::length,
                  .range = Range{0, 1e6},
                  .help = "depth under the surface; deeper cells are core"},
                 {.name = "material", .type = "Material", .help = "material of the core"}},
      .example = "core = {depth = \"12 mm\", material = {young = \"1 MPa\", density = 1000}}"});
  api.add(ConstantEntry{{.name = "mesh_endings",
                         .type = "list of strings",
                         .help = "endings of the mesh files that s.import reads: \".obj\", ..."},
                        [](lua_State* L) { push(L, voxelize::mesh_endings()); }});
  api.add(FunctionEntry{
      .name = "voxelize",
      .group = kGroup,
      .summary = "Fills a mesh with cells, part by part. Each cell has one material.",
      .arguments = {{.name = "mesh",
                     .type = "Mesh",
                     .help = "surfaces of solids, one or more parts"}},
      .options =
          {{.name = "cell",
            .type = "quantity",
            .dimension = Dimension::length,
            .range = Range{1e-9, 1e6},
            .fallback = "longest side / 32",
            .help = "edge of a cell"},
           {.name = "materials",
            .type = "table of Material by part",
            .fallback = "fallback for all parts",
            .help = "materials by the name of a part or by its material name in the file"},
           {.name = "fallback",
            .type = "Material",
            .fallback = fmt::format("{{young = 1e6, density = 1000, damping_ratio = {}}}",
                                    kUsualDampingRatio),
            .help = "material of parts that materials does not name"},
           {.name = "priority",
            .type = "list of strings",
            .fallback = "order of the file",
            .help = "order in which parts claim cells that lie in several parts"},
           {.name = "core", .type = "Core", .fallback = "none", .help = "core under a shell"},
           {.name = "paint",
            .type = "function(x, y, z, depth, material) -> name",
            .fallback = "none",
            .help = "called for each cell with its centre and depth [m] and its material's name; "
                    "returns the name of one of the materials, or nothing to keep the material"},
           {.name = "repair",
            .type = "one of",
            .fallback = "\"auto\"",
            .help = "what to do with holes and other faults of the mesh",
            .choices = words_of<voxelize::Repair>()},
           {.name = "cut_cells",
            .type = "boolean",
            .fallback = "false",
            .help = "count each cell that the surface cuts by the fraction of it that is inside, "
                    "and touch obstacles at points of the surface: for round and slanting "
                    "surfaces; of the lattice corners alone"},
           {.name = "for_lattice",
            .type = "boolean",
            .fallback = "false",
            .help = "whether a lattice will be built on the cells: its memory is then checked too, "
                    "before the cells are made"}},
      .returns = "Grid",
      .errors = "A mesh that encloses nothing, cells too large or too small, or more than the "
                "memory holds; without repair, an open part (the message names part and hole).",
      .example = "local grid = s.voxelize(mesh, {cell = \"2 mm\", materials = {\n"
                 "  rod = {young = \"10 MPa\", density = 1000, damping = 0.004}}})",
      .call = voxelize_binding});
}

}  // namespace

void describe_voxelize(Api& api) {
  describe_mesh(api);
  describe_solid(api);
  api.add(FunctionEntry{
      .name = "import",
      .group = kGroup,
      .summary = "Reads a mesh: OBJ, STL, PLY, GLB/glTF, FBX, OFF or Collada.",
      .arguments = {{.name = "path", .type = "string", .help = "file to read"}},
      .options = {{.name = "unit",
                   .type = "one of",
                   .fallback = "the file's, else \"m\", which is reported",
                   .help = "unit of length of the file",
                   .choices = length_units()},
                  {.name = "up",
                   .type = "one of",
                   .fallback = "the file's, else the usual one of the format, which is reported",
                   .help = "axis of the file that points up",
                   .choices = words_of<voxelize::UpAxis>()}},
      .returns = "Mesh: in metres, z up",
      .errors = "No such file, not a mesh, no triangles, coordinates that are not finite.",
      .example = "local mesh = s.import(\"dumbbell.obj\", {unit = \"cm\", up = \"z\"})",
      .call = import_binding});
  describe_voxelize_function(api);
  describe_grid(api);
  describe_bodies(api);
  api.add(FunctionEntry{
      .name = "lattice",
      .group = kGroup,
      .summary = "Builds the cubic lattice of masses and springs on a grid (6 + 12 neighbours).",
      .arguments = {{.name = "grid", .type = "Grid", .help = "filled cells"}},
      .options = parameters_of<voxelize::LatticeOptions>(),
      .returns = "Model: with the mesh's surface bound to its nodes",
      .errors = "An empty grid.",
      .example = "local base = s.lattice(grid, {style = \"centers\"})",
      .call = lattice_binding});
  describe_random(api);
}

}  // namespace springlod::scripting
