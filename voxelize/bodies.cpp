#include "voxelize/bodies.hpp"

#include <array>
#include <cstddef>
#include <utility>

namespace springlod::voxelize {
namespace {

// Cells that touch along x.
struct Run {
  std::int32_t first = 0;  // x of its ends
  std::int32_t last = 0;
};

// The runs of one y and z, by ascending x.
struct Row {
  std::int32_t y = 0;
  std::int32_t z = 0;
  std::uint32_t begin = 0;  // numbers of runs
  std::uint32_t end = 0;
};

struct Rows {
  std::vector<Row> rows;  // in the order (z, y)
  std::vector<Run> runs;
};

Rows rows_of(const std::vector<CellIndex>& cells) {
  Rows all;
  for (const auto& [x, y, z] : cells) {
    const bool same_row = !all.rows.empty() && all.rows.back().y == y && all.rows.back().z == z;
    if (same_row && all.runs.back().last + 1 == x) {
      all.runs.back().last = x;
      continue;
    }
    const auto number = static_cast<std::uint32_t>(all.runs.size());
    if (!same_row) all.rows.push_back({y, z, number, number});
    all.runs.push_back({x, x});
    all.rows.back().end = number + 1;
  }
  return all;
}

// Unites the runs of two neighbouring rows that share a corner.
void unite_touching(const std::vector<Run>& runs, const Row& row, const Row& other,
                    DisjointSets& sets) {
  for (std::uint32_t a = row.begin, b = other.begin; a < row.end && b < other.end;) {
    if (runs[a].first <= runs[b].last + 1 && runs[b].first <= runs[a].last + 1) sets.unite(a, b);
    if (runs[a].last < runs[b].last)
      ++a;
    else
      ++b;
  }
}

}  // namespace

DisjointSets::Numbers bodies_of(const std::vector<CellIndex>& cells) {
  const auto [rows, runs] = rows_of(cells);
  DisjointSets sets(static_cast<std::uint32_t>(runs.size()));
  // Steps in (y, z) to the neighbouring rows before a row, which lie ever closer to it.
  constexpr std::array<std::pair<int, int>, 4> kBefore{{{-1, -1}, {0, -1}, {1, -1}, {-1, 0}}};
  std::array<std::size_t, kBefore.size()> at{};
  for (const Row& row : rows)
    for (std::size_t i = 0; i < kBefore.size(); ++i) {
      const std::pair wanted(row.z + kBefore[i].second, row.y + kBefore[i].first);
      while (std::pair(rows[at[i]].z, rows[at[i]].y) < wanted) ++at[i];
      const Row& other = rows[at[i]];
      if (std::pair(other.z, other.y) == wanted) unite_touching(runs, row, other, sets);
    }
  const DisjointSets::Numbers of_runs = sets.numbers();
  DisjointSets::Numbers bodies{{}, of_runs.count};
  bodies.of.reserve(cells.size());
  for (std::uint32_t r = 0; r < runs.size(); ++r)
    bodies.of.insert(bodies.of.end(), static_cast<std::size_t>(runs[r].last - runs[r].first) + 1,
                     of_runs.of[r]);
  return bodies;
}

}  // namespace springlod::voxelize
