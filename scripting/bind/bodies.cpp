// The bodies of a grid.

#include <utility>

#include <fmt/format.h>

#include "base/message.hpp"
#include "scripting/bind/tables/values.hpp"
#include "scripting/bind/topics.hpp"
#include "scripting/engine/call.hpp"
#include "voxelize/cells/separate.hpp"

namespace springlod::scripting {
namespace {

std::shared_ptr<const GridValue> value_of(voxelize::GridBody body, const GridValue& whole,
                                          std::size_t number, std::size_t count) {
  auto value = std::make_shared<GridValue>();
  value->grid = std::move(body.grid);
  value->voxelized = whole.voxelized;
  value->provenance = whole.provenance;
  value->provenance.set("body", fmt::format("{} of {}", number, count));
  if (whole.mesh) {
    auto mesh = std::make_shared<MeshValue>();
    mesh->mesh = std::move(body.mesh);
    mesh->report = whole.mesh->report;
    mesh->provenance = whole.mesh->provenance;
    value->mesh = mesh;
  }
  return value;
}

void say_left_out(Call& call, const voxelize::SeparateBodies& found, const GridValue& whole,
                  voxelize::Bodies which) {
  if (which == voxelize::Bodies::largest) {
    const std::size_t kept = found.bodies.front().grid.cells.size();
    call.session().console().say(fmt::format(
        "kept the largest of {} bodies: {} of {} cells ({:.3g} %)", found.bodies.size(), kept,
        whole.grid.cells.size(),
        100 * static_cast<double>(kept) / static_cast<double>(whole.grid.cells.size())));
  }
  if (found.stray_triangles > 0)
    call.session().console().say(fmt::format("left out {} more than a cell from all bodies",
                                             counted(found.stray_triangles, "triangle")));
}

int bodies_binding(Call& call) {
  const auto whole = call.value<GridValue>(1);
  TableReader reader = call.options(2);
  voxelize::Bodies which = voxelize::Bodies::separate;
  reader.read("bodies", which);
  reader.finish();
  std::vector<std::shared_ptr<const GridValue>> values;
  if (which == voxelize::Bodies::together || voxelize::count_bodies(whole->grid) < 2) {
    values.push_back(whole);
    return call.give(values);
  }
  voxelize::SeparateBodies found =
      voxelize::separate_bodies(whole->grid, whole->mesh ? whole->mesh->mesh : TriangleMesh{});
  say_left_out(call, found, *whole, which);
  const std::size_t count = found.bodies.size();
  if (which == voxelize::Bodies::largest) found.bodies.resize(1);
  for (std::size_t n = 0; n < found.bodies.size(); ++n)
    values.push_back(value_of(std::move(found.bodies[n]), *whole, n + 1, count));
  return call.give(values);
}

}  // namespace

void describe_bodies(Api& api) {
  api.add(FunctionEntry{
      .name = "bodies",
      .group = "From mesh to model",
      .summary = "Takes a grid apart into bodies that do not touch: the objects of a file, or a "
                 "scan and its debris.",
      .arguments = {{.name = "grid", .type = "Grid", .help = "filled cells"}},
      .options = {{.name = "bodies",
                   .type = "one of",
                   .fallback = "\"separate\"",
                   .help = "grids to make",
                   .choices = words_of<voxelize::Bodies>()}},
      .returns = "list of Grid: each with the triangles of the mesh that belong to it; a grid of "
                 "one body comes back as it is",
      .errors = "Not a grid.",
      .example = "for _, body in ipairs(s.bodies(grid)) do print(body, s.lattice(body)) end",
      .call = bodies_binding});
}

}  // namespace springlod::scripting
