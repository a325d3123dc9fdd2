#pragma once

#include <cstdint>
#include <vector>

#include "elastic/loads/static_loads.hpp"

namespace springlod {

/// Loads on patches of the surface: the border nodes around one of them, which share 1 N evenly.
/// Where they pull is drawn at random, the same for the same seed. All throw InputError if there is
/// no border node to pull at.
struct LocalLoadOptions {
  std::uint32_t count = 24;
  std::uint64_t seed = 1;
  /// Radius of a patch over the mean spring length: some thirty nodes, of which a level of a fifth
  /// of them keeps half a dozen. How a level answers to smaller ones depends on which groups they
  /// happen to cover.
  double radius = 3;
  /// Nodes that patches lie within, of which those on the border count; empty: all of the model.
  std::vector<std::uint32_t> within = {};
};

/// Two patches, pulled apart: every other pair near each other (at most two radii), the others
/// anywhere; about half of them along the line through their middles, half in any direction.
/// "patches 1", ... Fewer than asked for, or none, where there is no room for two.
std::vector<StaticLoad> patch_pairs(const MassSpringModel& model, const LocalLoadOptions& options);

/// A patch and the one that lies opposite as seen along the surface's normal, squeezed together:
/// "pinch 1", ... The one opposite may lie outside the nodes chosen.
std::vector<StaticLoad> pinches(const MassSpringModel& model, const LocalLoadOptions& options);

/// One patch pushed in any direction: "push 1", ... What balances it is the inertia of the body, or
/// whatever holds it; see solve_static.
std::vector<StaticLoad> pushes(const MassSpringModel& model, const LocalLoadOptions& options);

}  // namespace springlod
