#include "lod/merging/merge_corners.hpp"

#include <algorithm>
#include <array>
#include <cassert>
#include <cstddef>
#include <cstdint>
#include <utility>

#include "base/prefetch.hpp"
#include "lod/merging/members.hpp"

namespace springlod::lod {
namespace {

/// A fine corner between four different groups, of which the apex is known.
struct Candidate {
  std::uint64_t lower;  // the lowest group of its neighbours, then the next: 32 bits each
  std::uint32_t highest;
  double young;

  std::array<std::uint32_t, 3> groups() const {
    return {static_cast<std::uint32_t>(lower >> 32U), static_cast<std::uint32_t>(lower), highest};
  }
};

bool before(const Candidate& l, const Candidate& r) {
  return l.lower != r.lower ? l.lower < r.lower : l.highest < r.highest;
}

bool same_groups(const Candidate& l, const Candidate& r) {
  return l.lower == r.lower && l.highest == r.highest;
}

/// The first corner of each node, and the end: N + 1 numbers.
std::vector<std::uint32_t> starts(const std::vector<Corner>& corners, std::size_t nodes) {
  std::vector<std::uint32_t> start(nodes + 1, 0);
  for (const Corner& corner : corners) ++start[corner.node[0] + 1];
  for (std::size_t i = 0; i < nodes; ++i) start[i + 1] += start[i];
  return start;
}

/// Whether a corner with the apex `node` has the three other nodes, of which `lowest` is the
/// lowest.
bool same_nodes(const Corner& corner, std::uint32_t lowest, std::uint32_t i, std::uint32_t j) {
  return corner.node[1] == lowest && ((corner.node[2] == i && corner.node[3] == j) ||
                                      (corner.node[2] == j && corner.node[3] == i));
}

class Merger {
 public:
  Merger(const std::vector<Corner>& fine, const Groups& groups, const std::vector<Vec3>& rest)
      : fine_(fine),
        groups_(groups),
        rest_(rest),
        first_(starts(fine, groups.of.size())),
        row_start_(groups.count + 1, 0),
        marks_(groups.count, 0) {}

  std::vector<Corner> run() {
    const Members members(groups_);
    // A level has about as many corners per node as the finer one.
    merged_.reserve(fine_.size() * groups_.count / groups_.of.size());
    constexpr std::uint32_t kAhead = 8;  // prefetch distance in groups
    for (std::uint32_t apex = 0; apex < groups_.count; ++apex) {
      if (apex + kAhead < groups_.count)
        for (const std::uint32_t i : members.of(apex + kAhead))
          prefetch(fine_.data() + first_[i], fine_.data() + first_[i + 1]);
      gather(apex, members.of(apex));
      std::sort(row_.begin(), row_.end(), before);
      add_row(apex);
      row_start_[apex + 1] = static_cast<std::uint32_t>(merged_.size());
    }
    return std::move(merged_);
  }

 private:
  // The candidates whose apex is in group `apex`.
  void gather(std::uint32_t apex, std::span<const std::uint32_t> members) {
    std::size_t most = 0;
    for (const std::uint32_t i : members) most += first_[i + 1] - first_[i];
    row_.resize(most);
    std::size_t count = 0;
    for (const std::uint32_t i : members)
      for (std::uint32_t c = first_[i]; c < first_[i + 1]; ++c) {
        const std::uint32_t a = groups_.of[fine_[c].node[1]];
        const std::uint32_t b = groups_.of[fine_[c].node[2]];
        const std::uint32_t d = groups_.of[fine_[c].node[3]];
        const std::uint32_t low = std::min(a, b), high = std::max(a, b);
        const std::uint64_t lowest = std::min(low, d);
        const std::uint32_t middle = std::max(low, std::min(high, d));
        row_[count] = {lowest << 32U | middle, std::max(high, d), fine_[c].young};
        // No branch: it would be mispredicted often.
        const auto differ = static_cast<unsigned>(a != b) & static_cast<unsigned>(a != d) &
                            static_cast<unsigned>(b != d) & static_cast<unsigned>(a != apex) &
                            static_cast<unsigned>(b != apex) & static_cast<unsigned>(d != apex);
        count += differ;
      }
    row_.resize(count);
  }

  // One corner for each run of equal candidates.
  void add_row(std::uint32_t apex) {
    const std::size_t row = merged_.size();
    for (std::size_t at = 0, next = 0; at < row_.size(); at = next) {
      double change = 0;  // of E; so the mean of equal numbers is exactly that number
      for (next = at; next < row_.size() && same_groups(row_[next], row_[at]); ++next)
        change += row_[next].young - row_[at].young;
      const auto& [i, j, k] = row_[at].groups();
      const std::uint64_t mark = mark_of(apex, i, j, k);
      if (exists(i, mark, apex, j, k) || exists(j, mark, apex, i, k) || exists(k, mark, apex, i, j))
        continue;
      Corner corner{{apex, i, j, k}, row_[at].young + change / static_cast<double>(next - at)};
      if (!orient(corner, rest_)) continue;
      merged_.push_back(corner);
      marks_[apex] |= mark;
    }
    std::sort(merged_.begin() + static_cast<std::ptrdiff_t>(row), merged_.end(),
              [](const Corner& l, const Corner& r) { return l.node < r.node; });
  }

  // One of 64 bits, the same for the four nodes in any order. Most rows have few of them set.
  static std::uint64_t mark_of(std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t d) {
    return std::uint64_t{1} << ((a + b + c + d) % 64U);
  }

  // Whether the lower apex `other` has a corner of the same nodes; i < j.
  bool exists(std::uint32_t other, std::uint64_t mark, std::uint32_t apex, std::uint32_t i,
              std::uint32_t j) const {
    if (other > apex || (marks_[other] & mark) == 0) return false;
    const std::uint32_t lowest = std::min(apex, i);
    const std::uint32_t p = std::max(apex, i);
    for (std::uint32_t c = row_start_[other]; c < row_start_[other + 1]; ++c)
      if (same_nodes(merged_[c], lowest, p, j)) return true;
    return false;
  }

  const std::vector<Corner>& fine_;
  const Groups& groups_;
  const std::vector<Vec3>& rest_;
  std::vector<std::uint32_t> first_;
  std::vector<Candidate> row_;
  std::vector<Corner> merged_;
  std::vector<std::uint32_t> row_start_;  // the first corner of each group in merged_
  std::vector<std::uint64_t> marks_;      // of the corners of each group
};

}  // namespace

std::vector<Corner> merge_corners(const std::vector<Corner>& fine, const Groups& groups,
                                  const std::vector<Vec3>& rest) {
  assert(rest.size() == groups.count);
  if (fine.empty()) return {};
  return Merger(fine, groups, rest).run();
}

}  // namespace springlod::lod
