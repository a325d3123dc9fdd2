#include "voxelize/cells/solid_field.hpp"

#include <cmath>
#include <cstddef>
#include <functional>

#include <tbb/blocked_range.h>
#include <tbb/parallel_reduce.h>

#include "voxelize/cells/inside.hpp"
#include "voxelize/cells/winding_fill.hpp"
#include "voxelize/mesh/winding.hpp"

namespace springlod::voxelize {
namespace {

// Relative difference between the volumes of cells and mesh above which a single surface is tested
// for crossing itself: above the usual error of a body of some ten cells.
constexpr double kSuspicious = 0.02;
// The winding number is an integer but for the error of far triangles, and on the surface.
constexpr double kHalf = 0.5;

std::vector<Triangle> all_triangles(const Shells& shells) {
  std::vector<Triangle> triangles = shells.outer;
  triangles.insert(triangles.end(), shells.cavity.begin(), shells.cavity.end());
  return triangles;
}

struct Enclosed {
  double doubled = 0;  // [cells]
  double reversed = 0;
  Enclosed operator+(const Enclosed& other) const {
    return {doubled + other.doubled, reversed + other.reversed};
  }
};

// Sums of whole numbers, which do not depend on the order.
Enclosed count_enclosed(const std::vector<CellIndex>& cells, const WindingNumber& surface) {
  using Range = tbb::blocked_range<std::size_t>;
  return tbb::parallel_reduce(
      Range(0, cells.size()), Enclosed{},
      [&](const Range& range, Enclosed sum) {
        for (std::size_t i = range.begin(); i != range.end(); ++i) {
          const double times = std::round(surface.at(Vec3(cells[i][0], cells[i][1], cells[i][2])));
          if (times > 1) sum.doubled += times - 1;
          if (times < 0) sum.reversed += 1;
        }
        return sum;
      },
      std::plus<>());
}

}  // namespace

SolidField closed_field(const Shells& shells, const std::vector<Vec3>& positions,
                        const CellFrame& frame) {
  const double cell_volume = std::pow(frame.cell, 3);
  const std::vector<Triangle> triangles = all_triangles(shells);
  if (shells.count == 1) {
    SolidField field{level_set(positions, triangles, frame)};
    const double filled = static_cast<double>(count_cells(*field.distance, frame)) * cell_volume;
    if (std::abs(filled - shells.volume) <= kSuspicious * shells.volume) return field;
  }
  const WindingNumber surface(positions, triangles);
  const bool reversed_too = shells.count == 1;
  SolidField field{level_set(positions, triangles, frame, [&](const CellIndex& c) {
    const double times = surface.at(Vec3(c[0], c[1], c[2]));
    return times > kHalf || (reversed_too && times < -kHalf);
  })};
  const Enclosed enclosed = count_enclosed(cells_inside(*field.distance, frame), surface);
  field.doubled = enclosed.doubled * cell_volume;
  field.reversed = enclosed.reversed * cell_volume;
  return field;
}

SolidField open_field(const Shells& shells, const std::vector<Vec3>& positions,
                      const CellFrame& frame) {
  const std::vector<Triangle> triangles = all_triangles(shells);
  const WindingNumber surface(positions, triangles);
  return {level_set(wound_cells(surface, positions, triangles, frame), frame)};
}

}  // namespace springlod::voxelize
