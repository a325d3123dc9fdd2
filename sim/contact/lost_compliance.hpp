#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "lod/transfer.hpp"
#include "model/binding.hpp"
#include "model/chain.hpp"
#include "model/vec.hpp"

namespace springlod::sim {

/// P points of the surface of a base, each bound to nodes of the base and of a level. These must
/// outlive this.
struct BoundSurface {
  const Binding& to_base;   ///< to nodes of the group and its spring neighbours
  const Binding& to_level;  ///< to the node of the group and its spring neighbours
  const std::vector<lod::GroupPoint>& points;  ///< P
};

/// Compliance tensor that merging removed at each point, the base's minus the level's [m/N], P: eq.
/// 65a of docs/method.md. Symmetric; below 0 along directions in which the level is more compliant.
///
/// A force on a point is spread over its nodes by their weights, and the displacement of the point
/// is interpolated by the same weights. The nodes of the group of the point and of its spring
/// neighbours move; all others are held, in both models. So the time grows with the surface alone.
/// None for points of large groups, for which this takes too long.
std::vector<std::optional<Mat3>> lost_compliance(const LodChain& chain, std::uint32_t level,
                                                 const BoundSurface& surface);

}  // namespace springlod::sim
