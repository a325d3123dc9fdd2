#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "base/option.hpp"
#include "model/chain.hpp"
#include "model/mass_spring.hpp"

namespace springlod::inline model {

/// A spring that pulls a node back to its place, in any direction: the force is stiffness times
/// displacement.
struct NodeSpring {
  std::uint32_t node = 0;
  double stiffness = 0;  ///< [N/m] > 0
};

/// What holds a body: nodes that keep their positions, and nodes on springs. In any order;
/// duplicates of nodes count once, the stiffnesses of springs of one node add up.
struct Support {
  Support() = default;
  // Most bodies are held at nodes alone.
  Support(std::vector<std::uint32_t> held, std::vector<NodeSpring> on_springs = {})
      : nodes(std::move(held)), springs(std::move(on_springs)) {}

  bool empty() const { return nodes.empty() && springs.empty(); }
  /// The nodes that are held, and those on springs.
  std::vector<std::uint32_t> all_nodes() const;

  std::vector<std::uint32_t> nodes;
  std::vector<NodeSpring> springs;
};

/// Flags, N: 1 for a node of the list. Throws InputError for a node that the model does not have.
std::vector<std::uint8_t> anchor_flags(const MassSpringModel& model,
                                       const std::vector<std::uint32_t>& anchored);

/// Throws InputError for nodes that the model does not have, and for a spring without a finite
/// stiffness above 0.
void validate(const Support& support, const MassSpringModel& model);

/// The support of the base as one of a level: a group is held if one of its nodes is
/// (mapped_nodes), and springs on its nodes pull at the group.
Support mapped_support(const Groups& of_base, const Support& support);

/// The option row of what holds a body.
template <class S>
struct SupportOption {
  const char* name;
  Support S::*member;
  const char* help;
  const char* fallback;
};
template <class S>
constexpr SupportOption<S> anchored_option(Support S::*member) {
  return {"anchored", member,
          "nodes that are held in place: their numbers, a function of a Node that returns true for "
          "them, or the anchors of a run",
          "none"};
}

}  // namespace springlod::inline model
