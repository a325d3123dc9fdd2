#pragma once

#include <algorithm>
#include <cstdint>
#include <memory>
#include <vector>

#include "base/prefetch.hpp"
#include "model/mass_spring.hpp"

namespace springlod::inline model {

/// The springs of each node in ascending order of neighbour, in half the memory of a full
/// adjacency: the model is sorted by (a, b), so the springs from a node to higher nodes are
/// consecutive already and only those to lower nodes are listed. Refers to the ends of the springs,
/// which must outlive it.
class SpringRows {
 public:
  explicit SpringRows(const MassSpringModel& model)
      : SpringRows(model.node_count(), model.a, model.b) {}
  /// Springs from a to b, a < b < node_count, sorted by (a, b).
  SpringRows(std::uint32_t node_count, const std::vector<std::uint32_t>& a,
             const std::vector<std::uint32_t>& b);

  std::uint32_t node_count() const { return static_cast<std::uint32_t>(start_.size() - 1); }
  std::uint32_t spring_count() const { return static_cast<std::uint32_t>(b_.size()); }

  std::uint32_t count(std::uint32_t node) const {
    const Start& start = start_[node];
    const Start& end = start_[node + 1];
    return end.lower - start.lower + end.higher - start.higher;
  }

  /// Calls visit(neighbour, spring) for each spring of `node`, in ascending order of neighbour.
  template <class Visit>
  void for_each(std::uint32_t node, const Visit& visit) const {
    const Start& start = start_[node];
    const Start& end = start_[node + 1];
    for (std::uint32_t e = start.lower; e < end.lower; ++e)
      visit(lower_[e].neighbour, lower_[e].spring);
    for (std::uint32_t s = start.higher; s < end.higher; ++s) visit(b_[s], s);
  }

  /// Whether a spring joins the two nodes.
  bool joined(std::uint32_t i, std::uint32_t j) const {
    const std::uint32_t low = std::min(i, j);
    const auto row = b_.begin();
    return std::binary_search(row + start_[low].higher, row + start_[low + 1].higher,
                              std::max(i, j));
  }

  /// Prefetching, for loops that visit nodes in random order: call `prefetch_row` some visits
  /// before a node, and `prefetch_start` some visits before that.
  void prefetch_start(std::uint32_t node) const { prefetch(&start_[node]); }
  void prefetch_row(std::uint32_t node) const {
    const Start& start = start_[node];
    const Start& end = start_[node + 1];
    prefetch(lower_.get() + start.lower, lower_.get() + end.lower);
    prefetch(b_.data() + start.higher, b_.data() + end.higher);
  }

 private:
  struct Lower {
    std::uint32_t neighbour, spring;
  };
  struct Start {
    std::uint32_t lower, higher;  // into lower_, and number of a spring
  };
  const std::vector<std::uint32_t>& b_;
  std::vector<Start> start_;        // N + 1
  std::unique_ptr<Lower[]> lower_;  // S
};

}  // namespace springlod::inline model
