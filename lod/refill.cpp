#include "lod/refill.hpp"

#include <cmath>
#include <cstdint>
#include <limits>
#include <utility>

#include <fmt/format.h>

#include "base/error.hpp"
#include "model/point_bins.hpp"

namespace springlod::lod {
namespace {

/// Maps every base node to the nearest of `nodes`.
Groups nearest_groups(const MassSpringModel& base, const std::vector<Vec3>& nodes) {
  const Box3 box = bounds(base.rest).merged(bounds(nodes));
  const auto count = static_cast<std::uint32_t>(nodes.size());
  const double spacing = box.sizes().norm() / std::cbrt(count);
  const PointBins bins(nodes, box, spacing);
  Groups groups{std::vector<std::uint32_t>(base.rest.size()), count};
  std::vector<std::uint32_t> size(count, 0);
  for (std::size_t i = 0; i < base.rest.size(); ++i) {
    groups.of[i] = bins.nearest(base.rest[i]).point;
    ++size[groups.of[i]];
  }
  for (std::uint32_t g = 0; g < count; ++g) {
    if (size[g] > 0) continue;
    std::size_t best = base.rest.size();
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < base.rest.size(); ++i) {
      const double squared = (base.rest[i] - nodes[g]).squaredNorm();
      if (size[groups.of[i]] < 2 || squared >= least) continue;
      best = i;
      least = squared;
    }
    // There are fewer groups than nodes, so some group has at least two.
    --size[groups.of[best]];
    groups.of[best] = g;
    size[g] = 1;
  }
  return groups;
}

}  // namespace

LodChain refill(const MassSpringModel& base, std::vector<Level> levels) {
  LodChain chain;
  chain.levels.push_back({base, identity_groups(base.node_count()), "base"});
  for (Level& level : levels) {
    const std::uint32_t before = chain.levels.back().model.node_count();
    if (level.model.node_count() >= before)
      throw InputError(
          fmt::format("refill: level {} would have {} nodes and the level before has {}; use fewer "
                      "nodes",
                      chain.levels.size(), level.model.node_count(), before));
    level.of_base = nearest_groups(base, level.model.rest);
    chain.levels.push_back(std::move(level));
  }
  return chain;
}

}  // namespace springlod::lod
