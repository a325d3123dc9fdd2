#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "model/mesh.hpp"
#include "voxelize/mesh/solid.hpp"

namespace springlod::voxelize {

/// The numbers of the solids in the order in which they claim cells: those with a part in
/// `priority`, then the others. Throws InputError for a name that no part has.
std::vector<std::size_t> claim_order(const TriangleMesh& mesh,
                                     const std::vector<SolidReport>& solids,
                                     const std::vector<std::string>& priority);

}  // namespace springlod::voxelize
