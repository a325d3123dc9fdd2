#pragma once

#include <memory>
#include <vector>

#include "model/mesh.hpp"
#include "voxelize/cells/frame.hpp"
#include "voxelize/mesh/shells.hpp"

namespace springlod::voxelize {

/// The inside of one solid, and how its surfaces enclose it.
struct SolidField {
  std::shared_ptr<DistanceField> distance;
  double doubled = 0;   ///< volume enclosed more than once, beyond the first time [m3]
  double reversed = 0;  ///< volume enclosed inside out, by a surface that crosses itself [m3]
};

/// The inside of a closed solid. A single surface that does not cross itself needs no orientation
/// (OpenVDB meshToVolume). For several surfaces, or if the volume of the cells differs from that of
/// the mesh, the winding number decides: inside are the places around which it is above 1/2, and
/// for a single surface also those around which it is below -1/2. Thus what lies inside several
/// surfaces is filled once; cavities and the pockets between crossing surfaces stay empty; bodies
/// in cavities are filled. `positions` are in cells (CellFrame::to_index).
SolidField closed_field(const Shells& shells, const std::vector<Vec3>& positions,
                        const CellFrame& frame);

/// The inside of a solid with holes: where its winding number is above 1/2.
SolidField open_field(const Shells& shells, const std::vector<Vec3>& positions,
                      const CellFrame& frame);

}  // namespace springlod::voxelize
