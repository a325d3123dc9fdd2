#pragma once

#include <cstdint>
#include <vector>

namespace springlod::lod {

struct KeyedNode {
  std::uint64_t key;
  std::uint32_t node;
};

/// Brings nodes into rising order of their keys in linear time; equal keys keep their order (radix
/// sort from the lowest digit up). Digits that all keys share cost nothing.
void radix_sort(std::vector<KeyedNode>& nodes);

/// A key that orders as the number does; -0 is 0. Not for NaN.
std::uint64_t radix_key(double number);

}  // namespace springlod::lod
