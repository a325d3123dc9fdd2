#pragma once

#include <cstdint>
#include <vector>

#include "base/choice.hpp"
#include "model/mesh.hpp"
#include "voxelize/grid.hpp"

namespace springlod::voxelize {

/// Which models are made of a grid whose cells form several bodies that do not touch.
enum class Bodies { together, largest, separate };

inline constexpr Choice<Bodies> kBodies[] = {
    {Bodies::together, "together", "one model of all bodies"},
    {Bodies::largest, "largest", "a model of the largest body; the others are left out"},
    {Bodies::separate, "separate", "a model of each body, the largest first"}};
constexpr ChoiceTable<Choice<Bodies>> choices(Bodies) {
  return {"bodies", kBodies};
}

/// A body of a grid and its surface.
struct GridBody {
  MaterialGrid grid;  ///< with the materials of its cells; damping ratios become times anew
  TriangleMesh mesh;  ///< its triangles and their vertices; without parts that have none
};

struct SeparateBodies {
  std::vector<GridBody> bodies;  ///< by descending number of cells, then in grid order
  /// Triangles of surfaces that are more than a cell from all bodies, such as debris too small to
  /// fill a cell. No body has them.
  std::uint64_t stray_triangles = 0;
};

/// The number of bodies of a grid: sets of cells that share at least a corner.
std::uint32_t count_bodies(const MaterialGrid& grid);

/// Takes a valid grid apart into its bodies. A triangle of `mesh` goes to the body of the cell that
/// is nearest to its centre. `mesh` may be empty.
SeparateBodies separate_bodies(const MaterialGrid& grid, const TriangleMesh& mesh);

}  // namespace springlod::voxelize
