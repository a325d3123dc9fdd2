#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "model/chain.hpp"
#include "model/mass_spring.hpp"
#include "model/spring_rows.hpp"

namespace springlod {

/// What draws two or three nodes together (the paper, section 5).
enum class Grouping {
  standard,       ///< nearest neighbours first, nodes in random order (5.1)
  priority_soft,  ///< key L (1 + 4 g L): low gradient and short springs first
  priority_hard,  ///< gradient first, distance second: the paper's words (5.2)
  compact,        ///< round groups straight from the base, see compact_groups
  metis,          ///< graph partitions straight from the base, see metis_groups
};

/// What may happen to border nodes (5.3).
enum class BorderRule {
  none,
  /// Border nodes merge only with border nodes; a node whose best candidate is of the other kind
  /// skips its own turn, yet others may pick it.
  weak,
  strong,  ///< border nodes never merge
};

/// Lower goes first. Called once a node.
using NodePriority = std::function<double(std::uint32_t node)>;
/// Lower goes first; NaN or infinity forbids the pair. Called once a spring, with a < b.
using PairCost = std::function<double(std::uint32_t a, std::uint32_t b)>;

struct GroupingOptions {
  Grouping grouping = Grouping::standard;
  BorderRule border = BorderRule::none;
  std::uint64_t seed = 1;
  double grading = 0.5;          ///< of compact groups by stiffness, see graded_shares
  NodePriority node_priority{};  ///< replaces the order in which nodes are visited
  PairCost pair_cost{};          ///< replaces the key by which neighbours are chosen
};

/// Puts nodes that are joined by springs into groups of 2 or 3 (each drawn with probability 1/2);
/// what is left over stays single. Same options, same bits.
Groups group_nodes(const MassSpringModel& model, const GroupingOptions& options);
/// The same for whom has the rows of its springs at hand.
Groups group_nodes(const MassSpringModel& model, const SpringRows& springs,
                   const GroupingOptions& options);

/// Groups named by hand: `sets` of node numbers; every other node stays single. Throws InputError:
/// a node in two sets or out of range, a set that springs do not hold together.
Groups groups_from_sets(const MassSpringModel& model,
                        const std::vector<std::vector<std::uint32_t>>& sets);

std::string to_string(Grouping grouping);
std::string to_string(BorderRule border);

}  // namespace springlod
