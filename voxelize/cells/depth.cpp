#include "voxelize/cells/depth.hpp"

#include <algorithm>

#include "voxelize/cells/frame.hpp"
#include "voxelize/cells/inside.hpp"
#include "voxelize/cells/nearest_surface.hpp"

namespace springlod::voxelize {
namespace {

CellFrame frame_of(const MaterialGrid& grid) {
  CellFrame frame{grid.cell, grid.origin, {}};
  for (const CellIndex& c : grid.cells)
    for (std::size_t d = 0; d < 3; ++d) frame.size[d] = std::max(frame.size[d], c[d] + 1);
  return frame;
}

}  // namespace

std::vector<float> measure_depth(const MaterialGrid& grid, const TriangleMesh& mesh) {
  const std::vector<std::uint32_t> labels(mesh.triangles.size(), 0);
  const std::vector<NearestPoint> nearest =
      nearest_surface(frame_of(grid), grid.cells, mesh.positions, mesh.triangles, labels);
  std::vector<float> depth;
  depth.reserve(grid.cells.size());
  for (std::size_t n = 0; n < grid.cells.size(); ++n) {
    const CellIndex& c = grid.cells[n];
    if (!grid.fraction.empty() && grid.distance != nullptr && distance_at(*grid.distance, c) > 0) {
      depth.push_back(0);  // of a cut cell whose centre is outside
      continue;
    }
    const Vec3 center(c[0], c[1], c[2]);
    depth.push_back(
        static_cast<float>(grid.cell * (nearest[n].point.cast<double>() - center).norm()));
  }
  return depth;
}

}  // namespace springlod::voxelize
