#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "model/vec.hpp"

namespace springlod::report {

/// An unstructured grid of cells of one kind: points in metres with values, cells with values.
struct VtuGrid {
  enum class Cell : std::uint8_t { line = 3, triangle = 5, tetrahedron = 10 };  ///< of VTK

  using Values = std::pair<std::string, std::vector<double>>;  ///< name, one value each

  std::vector<Vec3> points;
  Cell cell = Cell::line;
  std::vector<std::uint32_t> corners;  ///< points of all cells, one after the other
  std::vector<Values> of_points, of_cells;
};

/// A VTK XML file (.vtu) with raw appended arrays in double precision.
std::string vtu_text(const VtuGrid& grid, std::string_view origin);

}  // namespace springlod::report
