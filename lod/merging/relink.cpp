#include "lod/merging/relink.hpp"

#include <algorithm>
#include <cassert>
#include <span>
#include <utility>

#include <fmt/format.h>

#include "base/error.hpp"
#include "lod/merging/members.hpp"

namespace springlod::lod {
namespace {

struct RowEntry {
  std::uint32_t spring;
  std::uint32_t high;  // group of its other end
};

// The springs from the nodes of group `low` to higher groups.
void gather_row(const SpringRows& springs, const Groups& groups,
                std::span<const std::uint32_t> members, std::uint32_t low,
                std::vector<RowEntry>& row) {
  assert(std::is_sorted(members.begin(), members.end()));
  std::size_t ends = 0;
  for (const std::uint32_t i : members) ends += springs.count(i);
  row.resize(ends);
  std::size_t count = 0;
  for (const std::uint32_t i : members)
    springs.for_each(i, [&](std::uint32_t j, std::uint32_t spring) {
      row[count] = {spring, groups.of[j]};
      count += groups.of[j] > low ? 1 : 0;
    });
  row.resize(count);
}

// Appends the higher groups of a row to `highs`, sorted and without duplicates; the index in
// `highs` is the number of the pair. Sets pair_end of each higher group to the number plus one;
// smaller values of pair_end belong to earlier rows.
void append_pairs(const std::vector<RowEntry>& row, std::vector<std::uint32_t>& highs,
                  std::vector<std::uint32_t>& pair_end) {
  const std::size_t first = highs.size();
  std::size_t end = first;
  highs.resize(first + row.size());
  for (const RowEntry& entry : row) {
    highs[end] = entry.high;
    end += pair_end[entry.high] > first ? 0 : 1;  // no branch: it would be mispredicted often
    pair_end[entry.high] = static_cast<std::uint32_t>(first) + 1;
  }
  highs.resize(end);
  std::sort(highs.begin() + static_cast<std::ptrdiff_t>(first), highs.end());
  for (std::size_t pair = first; pair < end; ++pair)
    pair_end[highs[pair]] = static_cast<std::uint32_t>(pair) + 1;
}

}  // namespace

Relinking relink(const SpringRows& springs, const Groups& groups) {
  if (groups.of.size() != springs.node_count())
    throw InputError(fmt::format("groups: they map {} nodes, but the model has {}",
                                 groups.of.size(), springs.node_count()));
  validate(groups);
  constexpr std::uint32_t kAhead = 8;  // prefetch distance in rows
  const Members members(groups);
  Relinking links;
  links.into.assign(springs.spring_count(), Relinking::kInside);
  links.b.reserve(springs.spring_count());
  std::vector<RowEntry> row;
  std::vector<std::uint32_t> pair_end(groups.count, 0);
  std::vector<std::uint32_t> row_end(groups.count);
  for (std::uint32_t low = 0; low < groups.count; ++low) {
    if (low + kAhead < groups.count)
      for (const std::uint32_t i : members.of(low + kAhead)) springs.prefetch_row(i);
    gather_row(springs, groups, members.of(low), low, row);
    append_pairs(row, links.b, pair_end);
    for (const RowEntry& entry : row) links.into[entry.spring] = pair_end[entry.high] - 1;
    row_end[low] = static_cast<std::uint32_t>(links.b.size());
  }
  links.b.shrink_to_fit();
  links.a.reserve(links.b.size());
  for (std::uint32_t low = 0; low < groups.count; ++low) links.a.resize(row_end[low], low);
  return links;
}

Relinking compose(Relinking finer, Relinking coarser) {
  for (std::uint32_t& pair : finer.into)
    if (pair != Relinking::kInside) {
      assert(pair < coarser.into.size());
      pair = coarser.into[pair];
    }
  return {std::move(coarser.a), std::move(coarser.b), std::move(finer.into)};
}

}  // namespace springlod::lod
