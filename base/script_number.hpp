#pragma once

#include <cstdint>

namespace springlod::inline base {

/// The number of a node, spring, point or entry in a message: counted from 1, as scripts count
/// them. C++ counts from 0, and so do the errors' accessors. (Levels have no such number: level 0
/// is the base everywhere.)
constexpr std::uint64_t script_number(std::uint64_t index) {
  return index + 1;
}

}  // namespace springlod::inline base
