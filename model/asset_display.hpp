#pragma once

#include <vector>

#include <tiny_gltf.h>

#include "model/asset_buffer.hpp"
#include "model/chain.hpp"

namespace springlod {

/// Buffer views of exact arrays that the pictures share; -1 where there is none.
struct SharedViews {
  std::vector<int> spring_ends;  ///< of each level: pairs of uint32
  int triangles = -1;            ///< of the surface: triples of uint32
};

/// Adds what any glTF viewer shows: the surface and, side by side along x, the nodes and springs of
/// each level, in single precision under a root node that turns z up into glTF's y up.
void add_display(const LodAsset& asset, const SharedViews& shared, tinygltf::Model& gltf,
                 AssetBuffer& buffer);

}  // namespace springlod
