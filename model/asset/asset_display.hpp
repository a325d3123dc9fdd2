#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include <nlohmann/json.hpp>

#include "model/asset/asset_buffer.hpp"
#include "model/chain.hpp"

namespace springlod::inline model {

/// Adds what any glTF viewer shows: the surface and, side by side along x, the nodes and springs of
/// each level, in single precision under a root node that turns z up into glTF's y up.
/// `spring_ends`: of each level the buffer view of its springs' ends, pairs of uint32, which the
/// lines share; nothing for no springs.
void add_display(const LodAsset& asset, const std::vector<std::optional<std::size_t>>& spring_ends,
                 nlohmann::json& document, AssetBuffer& buffer);

}  // namespace springlod::inline model
