#include "lod/relink.hpp"

#include <algorithm>
#include <memory>
#include <numeric>
#include <span>

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
    const auto [low, high] = std::minmax(groups.of[a[s]], groups.of[b[s]]);
    if (low != high) ++rows.start[low + 2];
  }
  std::partial_sum(rows.start.begin(), rows.start.end(), rows.start.begin());
  rows.entries = std::make_unique_for_overwrite<Rows::Entry[]>(rows.start.back());
  for (std::size_t s = 0; s < a.size(); ++s) {
    const auto [low, high] = std::minmax(groups.of[a[s]], groups.of[b[s]]);
    if (low != high) rows.entries[rows.start[low + 1]++] = {static_cast<std::uint32_t>(s), high};
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
  links.b.reserve(rows.start.back());
  std::vector<std::uint32_t> pair_with(groups.count, Relinking::kInside);  // of the row at hand
  for (std::uint32_t low = 0; low < groups.count; ++low) {
    const std::span<const Rows::Entry> entries = rows.of(low);
    const auto row = static_cast<std::uint32_t>(links.b.size());
    for (const Rows::Entry& entry : entries) {
      std::uint32_t& pair = pair_with[entry.high];
      if (pair != Relinking::kInside && pair >= row) continue;
      pair = row;
      links.b.push_back(entry.high);
    }
    std::sort(links.b.begin() + row, links.b.end());
    for (std::uint32_t pair = row; pair < links.b.size(); ++pair) pair_with[links.b[pair]] = pair;
    for (const Rows::Entry& entry : entries) links.into[entry.spring] = pair_with[entry.high];
    links.a.resize(links.b.size(), low);
  }
  links.b.shrink_to_fit();
  return links;
}

}  // namespace springlod
