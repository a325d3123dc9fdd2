#include <array>

#include "report/export/draft.hpp"
#include "report/export/tetrahedra.hpp"
#include "report/export/vtk_grid.hpp"

namespace springlod::report {

VtkGrid vtk_springs(const MassSpringModel& model, const std::vector<Vec3>& x) {
  std::vector<std::array<std::uint32_t, 2>> ends;
  for (std::uint32_t s = 0; s < model.spring_count(); ++s) ends.push_back({model.a[s], model.b[s]});
  VtkGrid grid(x, ends.size());
  grid.cells(VtkCell::line, ends);
  return grid;
}

VtkGrid vtk_surface(const TriangleMesh& surface, const std::vector<Vec3>& points) {
  VtkGrid grid(points, surface.triangles.size());
  grid.cells(VtkCell::triangle, surface.triangles);
  std::vector<std::uint32_t> part(surface.triangles.size(), 0);
  for (std::uint32_t p = 0; p < surface.parts.size(); ++p) {
    const MeshPart& of = surface.parts[p];
    for (std::uint32_t t = 0; t < of.triangle_count; ++t) part[of.first_triangle + t] = p;
  }
  grid.cell_data("part", part);
  return grid;
}

namespace {

void add_nodes(VtkGrid& grid, const MassSpringModel& model) {
  grid.point_data("mass", model.mass);
  grid.point_data("volume", model.volume);
  grid.point_data("contact_area", model.contact_area);
  grid.point_data("border", model.border);
  grid.point_data("material", model.material);
}

std::string springs_file(const ExportedModel& body) {
  VtkGrid grid = vtk_springs(body.model, body.model.rest);
  add_nodes(grid, body.model);
  grid.cell_data("rest_length", body.model.rest_length);
  grid.cell_data("stiffness", body.model.stiffness);
  grid.cell_data("damping", body.model.damping);
  return grid.file(body.origin);
}

std::string tetrahedra_file(const ExportedModel& body, const Tetrahedra& tetrahedra) {
  const MassSpringModel& model = body.model;
  VtkGrid grid(model.rest, tetrahedra.nodes.size());
  grid.cells(VtkCell::tetrahedron, tetrahedra.nodes);
  add_nodes(grid, model);
  grid.cell_data("material", tetrahedra.material);
  grid.cell_data("young", young_of(model, tetrahedra));
  grid.cell_data("poisson", poisson_of(model, tetrahedra));
  grid.cell_data("density", density_of(model, tetrahedra));
  return grid.file(body.origin);
}

}  // namespace

ExportDraft draft_vtk(const ExportedModel& body) {
  ExportDraft draft;
  draft.files = {{".vtu", springs_file(body)}};
  const Tetrahedra tetrahedra = tetrahedra_of_cells(body.model);
  if (tetrahedra.empty())
    draft.losses = {no_tetrahedra(body.model)};
  else
    draft.files.push_back({"-tetrahedra.vtu", tetrahedra_file(body, tetrahedra)});
  if (body.surface)
    draft.files.push_back(
        {"-surface.vtu", vtk_surface(*body.surface, surface_points(body)).file(body.origin)});
  draft.losses.emplace_back("names of materials and parts: they are numbers");
  if (body.surface) draft.losses.emplace_back("the weights by which nodes move the surface");
  if (!body.model.dilatation.empty()) draft.losses.emplace_back("dilatation terms");
  return draft;
}

}  // namespace springlod::report
