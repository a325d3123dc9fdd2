#pragma once

#include <nlohmann/json.hpp>

#include "model/asset/gltf_builder.hpp"
#include "model/chain.hpp"

namespace springlod::inline model {

/// Adds what any glTF viewer shows, in single precision: the surface and, side by side along x, the
/// nodes and springs of each level. A root node rotates z up to glTF's y up. The LINES primitives
/// share the arrays of the ends of the springs with the extension.
void add_display(const LodAsset& asset, const nlohmann::json& extension, GltfBuilder& gltf);

/// Adds the scene of a slim asset, which uses the arrays of its extension: the surface without
/// normals or, without a surface, the nodes and springs of level 0.
void add_slim_display(const LodAsset& asset, const nlohmann::json& extension, GltfBuilder& gltf);

}  // namespace springlod::inline model
