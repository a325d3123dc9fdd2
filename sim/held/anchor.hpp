#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "model/anchors.hpp"
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

/// A spring and a damper between each node of an anchor and the place where the anchor would hold
/// it. The nodes share the stiffness by their masses.
struct AnchorSpring {
  double stiffness = 0;  ///< of all of them together, along any direction [N/m] > 0
  double damping = 0;    ///< damping time: the dampers have this times the stiffness [s] >= 0
};

/// Nodes that a run holds: they stay where they are at its start, or follow a path as one rigid
/// body, whatever acts on them (HeldNodes); or springs pull them to where they would be then
/// (AnchorSprings).
struct Anchor {
  std::string name;                  ///< for messages and tables
  std::vector<std::uint32_t> nodes;  ///< of the model that is run
  /// Poses in the order of their times; at time 0 there is none but the start. Between them, each
  /// component is a monotone cubic of time; the anchor is at rest at both ends, and later. Empty:
  /// it stays.
  std::vector<AnchorKey> path = {};
  /// The point about which it turns, at the start [m]; none: the centre of mass of its nodes.
  std::optional<Vec3> pivot = std::nullopt;
  std::optional<AnchorSpring> spring = std::nullopt;
};

/// Throws InputError naming the anchor: without nodes, with nodes that the model does not have or
/// another anchor holds, with a path that is not finite or not in the order of time, with a spring
/// that is not finite, without stiffness or of a negative damping time.
void validate(const std::vector<Anchor>& anchors, const MassSpringModel& model);

/// The anchors of the base as anchors of a level: see mapped_nodes.
std::vector<Anchor> mapped(const std::vector<Anchor>& anchors, const Groups& of_base);

/// What they are in linear elasticity. They must fit the model.
Support support_of(const std::vector<Anchor>& anchors, const MassSpringModel& model);

/// Stiffness of the spring of each node of such an anchor, by ascending node [N/m].
std::vector<double> shared_stiffness(const Anchor& anchor, const MassSpringModel& model);

/// The nodes of all of them.
std::vector<std::uint32_t> nodes_of(const std::vector<Anchor>& anchors);

}  // namespace springlod::sim
