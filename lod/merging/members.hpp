#pragma once

#include <cstdint>
#include <numeric>
#include <span>
#include <vector>

#include "model/chain.hpp"

namespace springlod::lod {

/// The nodes of each group, ascending.
class Members {
 public:
  explicit Members(const Groups& groups) : start_(groups.count + 1, 0), node_(groups.of.size()) {
    for (const std::uint32_t g : groups.of) ++start_[g];
    std::partial_sum(start_.begin(), start_.end(), start_.begin());
    // start_ holds the ends of the groups; filling each group from its end moves them to the
    // starts.
    for (auto i = static_cast<std::uint32_t>(node_.size()); i-- > 0;)
      node_[--start_[groups.of[i]]] = i;
  }
  std::span<const std::uint32_t> of(std::uint32_t group) const {
    return {&node_[start_[group]], start_[group + 1] - start_[group]};
  }

 private:
  std::vector<std::uint32_t> start_;
  std::vector<std::uint32_t> node_;
};

}  // namespace springlod::lod
