#include <bit>
#include <cstdint>
#include <cstring>

#include <fmt/format.h>

#include "report/export/draft.hpp"
#include "report/export/tetrahedra.hpp"

namespace springlod::report {
namespace {

static_assert(std::endian::native == std::endian::little,
              "arrays are copied as they are in memory");

constexpr std::uint8_t kLine = 3, kTriangle = 5, kTetrahedron = 10;  // cell types of VTK

// A VTK XML file of an unstructured grid. The arrays stand behind the XML as they are in memory,
// each after its length in bytes ("appended raw").
class VtkGrid {
 public:
  VtkGrid(const std::vector<Vec3>& points, std::size_t cells)
      : points_(points.size()), cells_(cells) {
    static_assert(sizeof(Vec3) == 3 * sizeof(double));
    add_bytes(sections_[kPoints], "Points", "Float64", 3, points.data(), sizeof(Vec3) * points_);
  }

  // Cells of one type, each of `Row`'s nodes.
  template <class Rows>
  void cells(std::uint8_t type, const Rows& rows) {
    std::vector<std::int64_t> nodes, ends;
    for (const auto& row : rows) {
      nodes.insert(nodes.end(), row.begin(), row.end());
      ends.push_back(static_cast<std::int64_t>(nodes.size()));
    }
    add(kCells, "connectivity", nodes);
    add(kCells, "offsets", ends);
    add(kCells, "types", std::vector<std::uint8_t>(ends.size(), type));
  }

  template <class T>
  void point_data(const char* name, const std::vector<T>& values) {
    add(kPointData, name, values);
  }
  template <class T>
  void cell_data(const char* name, const std::vector<T>& values) {
    add(kCellData, name, values);
  }

  std::string file(const std::string& origin) const {
    std::string text = fmt::format(
        "<?xml version=\"1.0\"?>\n<!-- {}; SI units, z up -->\n"
        "<VTKFile type=\"UnstructuredGrid\" version=\"1.0\" byte_order=\"LittleEndian\" "
        "header_type=\"UInt64\">\n<UnstructuredGrid>\n"
        "<Piece NumberOfPoints=\"{}\" NumberOfCells=\"{}\">\n",
        origin, points_, cells_);
    constexpr const char* kNames[] = {"Points", "Cells", "PointData", "CellData"};
    for (std::size_t s = 0; s < std::size(kNames); ++s)
      text += fmt::format("<{0}>\n{1}</{0}>\n", kNames[s], sections_[s]);
    text += "</Piece>\n</UnstructuredGrid>\n<AppendedData encoding=\"raw\">\n_";
    return text + appended_ + "\n</AppendedData>\n</VTKFile>\n";
  }

 private:
  enum Section : std::uint8_t { kPoints, kCells, kPointData, kCellData };

  template <class T>
  void add(Section section, const char* name, const std::vector<T>& values) {
    const char* kind = std::is_floating_point_v<T> ? "Float" : std::is_signed_v<T> ? "Int" : "UInt";
    add_bytes(sections_[section], name, fmt::format("{}{}", kind, 8 * sizeof(T)), 1, values.data(),
              sizeof(T) * values.size());
  }

  void add_bytes(std::string& section, const char* name, const std::string& type, int components,
                 const void* values, std::uint64_t size) {
    section += fmt::format(
        "<DataArray type=\"{}\" Name=\"{}\" NumberOfComponents=\"{}\" format=\"appended\" "
        "offset=\"{}\"/>\n",
        type, name, components, appended_.size());
    char length[sizeof(size)];
    std::memcpy(length, &size, sizeof(size));
    appended_.append(length, sizeof(size));
    if (size > 0) appended_.append(static_cast<const char*>(values), size);
  }

  std::size_t points_, cells_;
  std::string sections_[4];
  std::string appended_;
};

void add_nodes(VtkGrid& grid, const MassSpringModel& model) {
  grid.point_data("mass", model.mass);
  grid.point_data("volume", model.volume);
  grid.point_data("contact_area", model.contact_area);
  grid.point_data("border", model.border);
  grid.point_data("material", model.material);
}

std::string springs_file(const ExportedModel& body) {
  const MassSpringModel& model = body.model;
  std::vector<std::array<std::uint32_t, 2>> ends;
  for (std::uint32_t s = 0; s < model.spring_count(); ++s) ends.push_back({model.a[s], model.b[s]});
  VtkGrid grid(model.rest, ends.size());
  grid.cells(kLine, ends);
  add_nodes(grid, model);
  grid.cell_data("rest_length", model.rest_length);
  grid.cell_data("stiffness", model.stiffness);
  grid.cell_data("damping", model.damping);
  return grid.file(body.origin);
}

std::string tetrahedra_file(const ExportedModel& body, const Tetrahedra& tetrahedra) {
  const MassSpringModel& model = body.model;
  VtkGrid grid(model.rest, tetrahedra.nodes.size());
  grid.cells(kTetrahedron, tetrahedra.nodes);
  add_nodes(grid, model);
  grid.cell_data("material", tetrahedra.material);
  grid.cell_data("young", young_of(model, tetrahedra));
  grid.cell_data("poisson", poisson_of(model, tetrahedra));
  grid.cell_data("density", density_of(model, tetrahedra));
  return grid.file(body.origin);
}

std::string surface_file(const ExportedModel& body) {
  const std::vector<Vec3> points = surface_points(body);
  VtkGrid grid(points, body.surface->triangles.size());
  grid.cells(kTriangle, body.surface->triangles);
  std::vector<std::uint32_t> part(body.surface->triangles.size(), 0);
  for (std::uint32_t p = 0; p < body.surface->parts.size(); ++p) {
    const MeshPart& of = body.surface->parts[p];
    for (std::uint32_t t = 0; t < of.triangle_count; ++t) part[of.first_triangle + t] = p;
  }
  grid.cell_data("part", part);
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
  if (body.surface) draft.files.push_back({"-surface.vtu", surface_file(body)});
  draft.losses.emplace_back("names of materials and parts: they are numbers");
  if (body.surface) draft.losses.emplace_back("the weights by which nodes move the surface");
  if (!body.model.dilatation.empty()) draft.losses.emplace_back("dilatation terms");
  return draft;
}

}  // namespace springlod::report
