#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <utility>
#include <vector>

#include "base/choice.hpp"
#include "base/option.hpp"
#include "model/chain.hpp"
#include "model/mass_spring.hpp"
#include "model/spring_rows.hpp"

namespace springlod {

/// Which nodes merge; what each means is said in its row, see choices(Grouping).
enum class Grouping { standard, priority_soft, priority_hard, compact, metis };

/// What may happen to border nodes (5.3).
enum class BorderRule {
  none,
  /// Border nodes merge only with border nodes; a node whose best candidate is of the other kind
  /// skips its own turn, yet others may pick it.
  weak,
  strong,  ///< border nodes never merge
};

inline constexpr Choice<BorderRule> kBorderRules[] = {
    {BorderRule::none, "none", "border nodes merge freely"},
    {BorderRule::weak, "weak", "border nodes merge only with border nodes"},
    {BorderRule::strong, "strong", "border nodes never merge"}};
constexpr ChoiceTable<Choice<BorderRule>> choices(BorderRule) {
  return {"border", kBorderRules};
}

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
constexpr auto option_rows(const GroupingOptions*) {
  return std::tuple(
      option("grouping", &GroupingOptions::grouping, "which nodes merge"),
      option("border", &GroupingOptions::border, "what may happen to border nodes"),
      option("seed", &GroupingOptions::seed,
             "of the random order; the same seed gives the same bits"),
      option("grading", &GroupingOptions::grading,
             "of compact: 0 .. 1, by how much stiff materials get larger groups than soft ones, "
             "for a longer step"));
}

/// What a maker of groups is given.
struct GroupingTask {
  const MassSpringModel& model;
  const SpringRows& springs;       ///< of the model
  std::uint32_t count;             ///< groups wanted
  const GroupingOptions& options;  ///< the grouping itself is the maker's own
};

/// A row of the table of groupings.
struct GroupingChoice : Choice<Grouping> {
  Groups (*make)(const GroupingTask& task);
  struct Traits {
    /// Makes as many groups as wanted, so that every level is merged straight from the base. The
    /// others make what they make, from the level before.
    bool from_base = false;
    bool follows_border = true;  ///< keeps BorderRule
  } traits = {};
};
ChoiceTable<GroupingChoice> choices(Grouping);
/// What scripts may ask of a grouping.
constexpr auto choice_traits(const GroupingChoice& row) {
  return std::array{std::pair("from_base", row.traits.from_base),
                    std::pair("follows_border", row.traits.follows_border)};
}

/// Groups of the maker that `options` name. Same options, same bits.
Groups group_nodes(const MassSpringModel& model, const GroupingOptions& options);
/// The same for whom has the rows of its springs at hand.
Groups group_nodes(const MassSpringModel& model, const SpringRows& springs,
                   const GroupingOptions& options);

/// Groups named by hand: `sets` of node numbers; every other node stays single. Throws InputError:
/// a node in two sets or out of range, a set that springs do not hold together.
Groups groups_from_sets(const MassSpringModel& model,
                        const std::vector<std::vector<std::uint32_t>>& sets);

/// Groups from the first node of each node's group, numbered by their lowest node: coarse nodes
/// keep the order of the fine ones, which keeps neighbours near in memory.
Groups groups_from_leaders(const std::vector<std::uint32_t>& leader);

}  // namespace springlod
