#pragma once

#include <cstdint>
#include <vector>

#include "model/chain.hpp"

namespace springlod::report {

/// The material of each part of the asset's surface, as an index into the materials of its base:
/// the one that has the name of the part or of its material in the mesh file; if there is none,
/// that with most of the weights by which the part's vertices are bound to nodes.
std::vector<std::uint32_t> part_materials(const LodAsset& asset);

}  // namespace springlod::report
