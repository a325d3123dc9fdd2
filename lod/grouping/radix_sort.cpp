#include "lod/grouping/radix_sort.hpp"

#include <array>
#include <bit>
#include <cstddef>

namespace springlod::lod {
namespace {

// 6 passes for 64 bits; the counters of a pass stay in the first-level cache.
constexpr unsigned kDigitBits = 11;
constexpr std::size_t kDigits = std::size_t{1} << kDigitBits;
constexpr unsigned kPasses = (64 + kDigitBits - 1) / kDigitBits;

std::size_t digit(std::uint64_t key, unsigned pass) {
  return (key >> (pass * kDigitBits)) & (kDigits - 1);
}

using Counts = std::array<std::uint32_t, kDigits>;

// Turns counts into the index of the first node of each digit.
void starts_from_counts(Counts& counts) {
  std::uint32_t start = 0;
  for (std::uint32_t& count : counts) {
    const std::uint32_t here = count;
    count = start;
    start += here;
  }
}

}  // namespace

void radix_sort(std::vector<KeyedNode>& nodes) {
  if (nodes.empty()) return;
  std::vector<Counts> counts(kPasses, Counts{});
  for (const KeyedNode& each : nodes)
    for (unsigned pass = 0; pass < kPasses; ++pass) ++counts[pass][digit(each.key, pass)];
  std::vector<KeyedNode> sorted(nodes.size());
  for (unsigned pass = 0; pass < kPasses; ++pass) {
    Counts& next = counts[pass];
    if (next[digit(nodes[0].key, pass)] == nodes.size()) continue;
    starts_from_counts(next);
    for (const KeyedNode& each : nodes) sorted[next[digit(each.key, pass)]++] = each;
    nodes.swap(sorted);
  }
}

std::uint64_t radix_key(double number) {
  constexpr std::uint64_t kSign = std::uint64_t{1} << 63U;
  const auto bits = std::bit_cast<std::uint64_t>(number + 0.0);  // -0 + 0 is +0
  return (bits & kSign) != 0 ? ~bits : bits | kSign;
}

}  // namespace springlod::lod
