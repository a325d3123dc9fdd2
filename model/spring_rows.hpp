#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "model/mass_spring.hpp"
#include "model/prefetch.hpp"

namespace springlod {

/// The springs of each node, as Adjacency tells them and in the same order, in half the memory: a
/// node's springs to higher nodes stand side by side in the model, so that only those to lower
/// nodes are listed. Refers to the model, which must outlive it.
class SpringRows {
 public:
  explicit SpringRows(const MassSpringModel& model);

  std::uint32_t count(std::uint32_t node) const {
    const Start& start = start_[node];
    const Start& end = start_[node + 1];
    return end.lower - start.lower + end.higher - start.higher;
  }

  /// Calls visit(neighbour, spring) for each spring of `node`, in rising order of neighbour.
  template <class Visit>
  void for_each(std::uint32_t node, const Visit& visit) const {
    const Start& start = start_[node];
    const Start& end = start_[node + 1];
    for (std::uint32_t e = start.lower; e < end.lower; ++e)
      visit(lower_[e].neighbour, lower_[e].spring);
    for (std::uint32_t s = start.higher; s < end.higher; ++s) visit(model_.b[s], s);
  }

  /// Who goes through nodes in no order waits for memory at each, unless it is asked for ahead:
  /// `prefetch_row` some visits before, `prefetch_start` some visits before that.
  void prefetch_start(std::uint32_t node) const { prefetch(&start_[node]); }
  void prefetch_row(std::uint32_t node) const {
    const Start& start = start_[node];
    const Start& end = start_[node + 1];
    prefetch(&lower_[start.lower], &lower_[end.lower]);
    prefetch(&model_.b[start.higher], &model_.b[end.higher]);
  }

 private:
  struct Lower {
    std::uint32_t neighbour, spring;
  };
  struct Start {
    std::uint32_t lower, higher;  // into lower_, and number of a spring
  };
  const MassSpringModel& model_;
  std::vector<Start> start_;        // N + 1
  std::unique_ptr<Lower[]> lower_;  // S
};

}  // namespace springlod
