#pragma once

#include <cstdint>
#include <vector>

namespace springlod::lod {

struct KeyedNode {
  std::uint64_t key;
  std::uint32_t node;
};

/// Sorts nodes by ascending keys in linear time; the order of equal keys is kept (radix sort from
/// the lowest digit up). Digits that are the same in all keys cost no pass.
void radix_sort(std::vector<KeyedNode>& nodes);

/// Integer key in the order of the numbers; -0 equals 0. NaN is not allowed.
std::uint64_t radix_key(double number);

}  // namespace springlod::lod
