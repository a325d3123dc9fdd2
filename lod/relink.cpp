#include "lod/relink.hpp"

#include <algorithm>
#include <memory>
#include <numeric>
#include <span>
#include <utility>

namespace springlod {
namespace {

// Springs between groups by the lower group of their ends: entries start[g] .. start[g+1]-1 belong
// to group g.
struct Rows {
  struct Entry {
    std::uint32_t spring;
    std::uint32_t high;  // the other group
  };
  std::vector<std::uint32_t> start;
  std::unique_ptr<Entry[]> entries;

  std::span<const Entry> of(std::uint32_t group) const {
    return {&entries[start[group]], &entries[start[group + 1]]};
  }
};

Rows rows_by_lower_group(const std::vector<std::uint32_t>& a, const std::vector<std::uint32_t>& b,
                         const Groups& groups) {
  Rows rows;
  // One place ahead: start[g+1] counts up from the start of row g to its end while rows are filled.
  rows.start.assign(groups.count + 2, 0);
  for (std::size_t s = 0; s < a.size(); ++s) {
    const std::uint32_t group_a = groups.of[a[s]];
    const std::uint32_t group_b = groups.of[b[s]];
    if (group_a != group_b) ++rows.start[std::min(group_a, group_b) + 2];
  }
  std::partial_sum(rows.start.begin(), rows.start.end(), rows.start.begin());
  rows.entries = std::make_unique_for_overwrite<Rows::Entry[]>(rows.start.back());
  for (std::size_t s = 0; s < a.size(); ++s) {
    const std::uint32_t group_a = groups.of[a[s]];
    const std::uint32_t group_b = groups.of[b[s]];
    if (group_a == group_b) continue;
    const std::uint32_t low = std::min(group_a, group_b);
    rows.entries[rows.start[low + 1]++] = {static_cast<std::uint32_t>(s),
                                           std::max(group_a, group_b)};
  }
  rows.start.pop_back();
  return rows;
}

}  // namespace

Relinking relink(const std::vector<std::uint32_t>& a, const std::vector<std::uint32_t>& b,
                 const Groups& groups) {
  const Rows rows = rows_by_lower_group(a, b, groups);
  Relinking links;
  links.into.assign(a.size(), Relinking::kInside);
  // Pairs by row, each row sorted; `high` has room for one more than there can be.
  std::vector<std::uint32_t> row_start{0};
  row_start.reserve(groups.count + 1);
  const auto high = std::make_unique_for_overwrite<std::uint32_t[]>(rows.start.back() + 1);
  std::uint32_t pairs = 0;
  // One more than the number of a group's pair in the row at hand; what is lower is of rows before.
  std::vector<std::uint32_t> pair_end(groups.count, 0);
  for (std::uint32_t low = 0; low < groups.count; ++low) {
    const std::uint32_t first = pairs;
    for (const Rows::Entry& entry : rows.of(low)) {
      high[pairs] = entry.high;
      pairs += pair_end[entry.high] > first ? 0 : 1;  // no branch: it would be a toss-up
      pair_end[entry.high] = first + 1;
    }
    std::sort(&high[first], &high[pairs]);
    for (std::uint32_t pair = first; pair < pairs; ++pair) pair_end[high[pair]] = pair + 1;
    for (const Rows::Entry& entry : rows.of(low))
      links.into[entry.spring] = pair_end[entry.high] - 1;
    row_start.push_back(pairs);
  }
  links.b.assign(&high[0], &high[pairs]);
  links.a.resize(pairs);
  for (std::uint32_t low = 0; low < groups.count; ++low)
    std::fill(links.a.begin() + row_start[low], links.a.begin() + row_start[low + 1], low);
  return links;
}

Relinking compose(Relinking finer, Relinking coarser) {
  for (std::uint32_t& pair : finer.into)
    if (pair != Relinking::kInside) pair = coarser.into[pair];
  return {std::move(coarser.a), std::move(coarser.b), std::move(finer.into)};
}

}  // namespace springlod
