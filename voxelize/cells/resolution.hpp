#pragma once

#include <cstddef>
#include <optional>
#include <string>

#include "model/mesh.hpp"
#include "voxelize/cells/slivers.hpp"
#include "voxelize/mesh/solid.hpp"

namespace springlod::voxelize {

/// What is wrong with a solid that `cells` cells of edge `cell` [m] fill, and a cell that resolves
/// it; nothing if their volume is within 10 % of `volume` [m3].
std::optional<std::string> volume_fault(const TriangleMesh& mesh, const SolidReport& solid,
                                        double volume, double cells, double cell);

/// The same for the slivers of a solid of `cells` cells; nothing if they are less than 1 % of it.
std::optional<std::string> sliver_fault(const SolidReport& solid, const Sliver& sliver,
                                        std::size_t cells);

}  // namespace springlod::voxelize
