#pragma once

#include <cstdint>
#include <vector>

#include "model/static_loads.hpp"

namespace springlod {

/// Loads on patches of the surface: the border nodes around one of them, which share 1 N evenly.
/// Where they pull is drawn at random, the same for the same seed. All throw InputError for a model
/// without border nodes.
struct LocalLoadOptions {
  std::uint32_t count = 24;
  std::uint64_t seed = 1;
  /// Radius of a patch over the mean spring length: some ten nodes, three across, about as fine as
  /// a level of a fifth of the nodes can still tell apart.
  double radius = 1.6;
};

/// Two patches anywhere, pulled apart along the line through their middles: "patches 1", ...
std::vector<StaticLoad> patch_pairs(const MassSpringModel& model, const LocalLoadOptions& options);

/// A patch and the one that lies opposite as seen along the surface's normal, squeezed together:
/// "pinch 1", ...
std::vector<StaticLoad> pinches(const MassSpringModel& model, const LocalLoadOptions& options);

/// One patch pushed in any direction: "push 1", ... What balances it is the inertia of the body, or
/// whatever holds it; see solve_static.
std::vector<StaticLoad> pushes(const MassSpringModel& model, const LocalLoadOptions& options);

}  // namespace springlod
