#pragma once

#include <cassert>
#include <cstdint>
#include <numeric>
#include <utility>
#include <vector>

namespace springlod::inline base {

/// Disjoint sets of the elements 0 .. count - 1 (union-find with path halving, Tarjan and van
/// Leeuwen 1984; linked towards the lower number). The lowest element represents its set.
class DisjointSets {
 public:
  explicit DisjointSets(std::uint32_t count) : parent_(count) {
    std::iota(parent_.begin(), parent_.end(), 0U);
  }

  /// Lowest element of the set of `i`.
  std::uint32_t lowest(std::uint32_t i) {
    assert(i < parent_.size());
    while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
    return i;
  }

  /// Merges the sets of x and y. Returns false if they were one set already.
  bool unite(std::uint32_t x, std::uint32_t y) {
    x = lowest(x);
    y = lowest(y);
    if (x == y) return false;
    if (y < x) std::swap(x, y);
    parent_[y] = x;
    return true;
  }

  /// Makes `i` a set of its own again. Call it for all elements of the set: otherwise the others
  /// still refer to `i`.
  void separate(std::uint32_t i) {
    assert(i < parent_.size());
    parent_[i] = i;
  }

  /// Set number of each element. Sets are numbered by their lowest element.
  struct Numbers {
    std::vector<std::uint32_t> of;
    std::uint32_t count = 0;
  };
  Numbers numbers() {
    Numbers numbers{std::vector<std::uint32_t>(parent_.size()), 0};
    for (std::uint32_t i = 0; i < parent_.size(); ++i) {
      const std::uint32_t first = lowest(i);
      numbers.of[i] = first == i ? numbers.count++ : numbers.of[first];
    }
    return numbers;
  }

 private:
  std::vector<std::uint32_t> parent_;
};

}  // namespace springlod::inline base
