#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "model/chain.hpp"
#include "model/mass_spring.hpp"
#include "model/vec.hpp"

namespace springlod::sim {

/// A pose on the path of an anchor, relative to the start of the run.
struct AnchorKey {
  double time = 0;           ///< [s] > 0
  Vec3 move = Vec3::Zero();  ///< displacement [m]
  Vec3 turn = Vec3::Zero();  ///< rotation vector, about the pivot: axis times angle [rad]
};

/// Nodes that a run holds: they stay where they are at its start, or follow a path as one rigid
/// body, whatever acts on them. See HeldNodes.
struct Anchor {
  std::string name;                  ///< for messages and tables
  std::vector<std::uint32_t> nodes;  ///< of the model that is run
  /// Poses in the order of their times; at time 0 there is none but the start. Between them, each
  /// component is a monotone cubic of time; the anchor is at rest at both ends, and later. Empty:
  /// it stays.
  std::vector<AnchorKey> path = {};
  /// The point about which it turns, at the start [m]; none: the centre of mass of its nodes.
  std::optional<Vec3> pivot = std::nullopt;
};

/// Throws InputError naming the anchor: without nodes, with nodes that the model does not have or
/// another anchor holds, with a path that is not finite or not in the order of time.
void validate(const std::vector<Anchor>& anchors, const MassSpringModel& model);

/// The anchors of the base as anchors of a level: see mapped_nodes.
std::vector<Anchor> mapped(const std::vector<Anchor>& anchors, const Groups& of_base);

/// The nodes of all of them.
std::vector<std::uint32_t> nodes_of(const std::vector<Anchor>& anchors);

}  // namespace springlod::sim
