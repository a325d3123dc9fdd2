#pragma once

#include <bit>
#include <cstdint>
#include <cstring>
#include <iterator>
#include <string>
#include <type_traits>
#include <vector>

#include <fmt/format.h>

#include "report/export/export.hpp"

namespace springlod::report {

static_assert(std::endian::native == std::endian::little,
              "arrays are copied as they are in memory");

/// Cell types of VTK.
enum class VtkCell : std::uint8_t { line = 3, triangle = 5, tetrahedron = 10 };

/// A VTK XML file of an unstructured grid. The arrays stand behind the XML as they are in memory,
/// each after its length in bytes ("appended raw").
class VtkGrid {
 public:
  VtkGrid(const std::vector<Vec3>& points, std::size_t cells)
      : points_(points.size()), cells_(cells) {
    static_assert(sizeof(Vec3) == 3 * sizeof(double));
    add_bytes(sections_[kPoints], "Points", "Float64", 3, points.data(), sizeof(Vec3) * points_);
  }

  /// Cells of one type: each row has the points of one.
  template <class Rows>
  void cells(VtkCell type, const Rows& rows) {
    std::vector<std::int64_t> nodes, ends;
    for (const auto& row : rows) {
      nodes.insert(nodes.end(), row.begin(), row.end());
      ends.push_back(static_cast<std::int64_t>(nodes.size()));
    }
    add(kCells, "connectivity", nodes);
    add(kCells, "offsets", ends);
    add(kCells, "types", std::vector(ends.size(), static_cast<std::uint8_t>(type)));
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

/// The springs of a model as lines between its nodes at `x` [m].
VtkGrid vtk_springs(const MassSpringModel& model, const std::vector<Vec3>& x);
/// The surface of a body with its vertices at `points` [m], and the mesh part of each triangle.
VtkGrid vtk_surface(const TriangleMesh& surface, const std::vector<Vec3>& points);

}  // namespace springlod::report
