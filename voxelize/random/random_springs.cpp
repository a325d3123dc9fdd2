#include "voxelize/random/random_springs.hpp"

#include <algorithm>
#include <cmath>
#include <tuple>

#include "model/point_bins.hpp"
#include "voxelize/index_lookup.hpp"

namespace springlod::voxelize {
namespace {

// Search radius in spacings. In a uniform packing it contains about 44 neighbours of a node, twice
// as many as needed; on a flat surface, half as many.
constexpr double kSearchRadius = 2.2;
constexpr double kWiden = 1.5;
// A path of cells may lead around a step of the surface if their centres lie within this many cells
// of the straight line; it cannot lead across a gap.
constexpr double kDetour = 1.5;
// Tests of the line per cell.
constexpr double kTestsPerCell = 3;
// Nodes on a face are moved into the cell behind it by this fraction of the way to its centre.
constexpr double kInset = 1e-3;

/// Tests whether filled cells connect two nodes along the straight line between them.
class Sight {
 public:
  Sight(const MaterialGrid& grid, const RandomNodes& nodes)
      : grid_(grid), nodes_(nodes), lookup_(grid.cells), seen_(grid.cells.size(), 0) {}

  bool joined(std::uint32_t a, std::uint32_t b) {
    if (nodes_.cell[a] == nodes_.cell[b]) return true;
    const Vec3 from = inside(a);
    const Vec3 to = inside(b);
    return straight(from, to) || detour(nodes_.cell[a], nodes_.cell[b], from, to);
  }

 private:
  // In cells from the origin of the grid.
  Vec3 inside(std::uint32_t node) const {
    const Vec3 at = (nodes_.at[node] - grid_.origin) / grid_.cell;
    return at + kInset * (center(nodes_.cell[node]) - at);
  }
  Vec3 center(std::uint32_t cell) const {
    const CellIndex& c = grid_.cells[cell];
    return {c[0] + 0.5, c[1] + 0.5, c[2] + 0.5};
  }

  bool straight(const Vec3& from, const Vec3& to) const {
    const int tests = 1 + static_cast<int>(kTestsPerCell * (to - from).norm());
    for (int i = 1; i < tests; ++i) {
      const Vec3 at = from + (to - from) * (static_cast<double>(i) / tests);
      const CellIndex cell{static_cast<std::int32_t>(std::floor(at.x())),
                           static_cast<std::int32_t>(std::floor(at.y())),
                           static_cast<std::int32_t>(std::floor(at.z()))};
      if (lookup_.find(cell) == kNoIndex) return false;
    }
    return true;
  }

  bool near_line(const Vec3& place, const Vec3& from, const Vec3& to) const {
    const Vec3 along = to - from;
    const double t = std::clamp((place - from).dot(along) / along.squaredNorm(), 0.0, 1.0);
    return (place - from - t * along).squaredNorm() <= kDetour * kDetour;
  }

  // A path across the faces of filled cells near the line.
  bool detour(std::uint32_t start, std::uint32_t goal, const Vec3& from, const Vec3& to) {
    ++search_;
    stack_.assign(1, start);
    seen_[start] = search_;
    while (!stack_.empty()) {
      const std::uint32_t cell = stack_.back();
      stack_.pop_back();
      if (cell == goal) return true;
      for (int axis = 0; axis < 3; ++axis)
        for (const int side : {-1, 1}) {
          CellIndex next = grid_.cells[cell];
          next[axis] += side;
          const std::uint32_t other = lookup_.find(next);
          if (other == kNoIndex || seen_[other] == search_) continue;
          seen_[other] = search_;
          if (near_line(center(other), from, to)) stack_.push_back(other);
        }
    }
    return false;
  }

  const MaterialGrid& grid_;
  const RandomNodes& nodes_;
  IndexLookup lookup_;
  std::vector<std::uint64_t> seen_;  // the last search that reached each cell
  std::uint64_t search_ = 0;
  std::vector<std::uint32_t> stack_;
};

bool shorter(const NodePair& l, const NodePair& r) {
  return std::tie(l.length, l.a, l.b) < std::tie(r.length, r.a, r.b);
}

bool same_pair(const NodePair& l, const NodePair& r) {
  return l.a == r.a && l.b == r.b;
}

/// The springs chosen so far among the candidates, which are sorted by length.
class Selection {
 public:
  Selection(const std::vector<NodePair>& candidates, std::uint32_t nodes, std::uint32_t least)
      : candidates_(candidates),
        least_(least),
        chosen_(candidates.size(), false),
        springs_(nodes, 0) {}

  void join_nearest() {
    std::vector<std::uint32_t> nearer(springs_.size(), 0);
    for (std::size_t i = 0; i < candidates_.size(); ++i) {
      const NodePair& pair = candidates_[i];
      if (nearer[pair.a] < least_ || nearer[pair.b] < least_) choose(i);
      ++nearer[pair.a];
      ++nearer[pair.b];
    }
  }

  void join_shortest_until(std::size_t wanted) {
    for (std::size_t i = 0; i < candidates_.size() && count_ < wanted; ++i)
      if (!chosen_[i]) choose(i);
  }

  void drop_longest_until(std::size_t wanted) {
    for (std::size_t i = candidates_.size(); i-- > 0 && count_ > wanted;) {
      const NodePair& pair = candidates_[i];
      if (!chosen_[i] || springs_[pair.a] <= least_ || springs_[pair.b] <= least_) continue;
      chosen_[i] = false;
      --springs_[pair.a];
      --springs_[pair.b];
      --count_;
    }
  }

  std::vector<NodePair> sorted() const {
    std::vector<NodePair> pairs;
    for (std::size_t i = 0; i < candidates_.size(); ++i)
      if (chosen_[i]) pairs.push_back(candidates_[i]);
    std::sort(pairs.begin(), pairs.end(), [](const NodePair& l, const NodePair& r) {
      return std::tie(l.a, l.b) < std::tie(r.a, r.b);
    });
    return pairs;
  }

 private:
  void choose(std::size_t i) {
    chosen_[i] = true;
    ++springs_[candidates_[i].a];
    ++springs_[candidates_[i].b];
    ++count_;
  }

  const std::vector<NodePair>& candidates_;
  std::uint32_t least_;
  std::vector<bool> chosen_;
  std::vector<std::uint32_t> springs_;  // of each node
  std::size_t count_ = 0;
};

/// Finds the pairs of nodes that filled cells connect.
class Search {
 public:
  Search(const MaterialGrid& grid, const RandomNodes& nodes, const Box3& box)
      : nodes_(nodes), sight_(grid, nodes), bins_(nodes.at, box, nodes.spacing), box_(box) {}

  std::vector<NodePair> run(std::uint32_t least) {
    std::vector<NodePair> pairs;
    std::vector<std::uint32_t> seen(size(), 0);
    for (std::uint32_t i = 0; i < size(); ++i)
      bins_.within(nodes_.at[i], kSearchRadius * nodes_.spacing,
                   [&](std::uint32_t j, const Vec3& span) {
                     if (j <= i || !sight_.joined(i, j)) return;
                     pairs.push_back({i, j, span, span.norm()});
                     ++seen[i];
                     ++seen[j];
                   });
    for (std::uint32_t i = 0; i < size(); ++i)
      if (seen[i] < least) append_far_pairs(i, least, pairs);
    std::sort(pairs.begin(), pairs.end(), shorter);
    pairs.erase(std::unique(pairs.begin(), pairs.end(), same_pair), pairs.end());
    return pairs;
  }

 private:
  std::uint32_t size() const { return static_cast<std::uint32_t>(nodes_.at.size()); }

  // For a node with too few connected nodes within the search radius.
  void append_far_pairs(std::uint32_t node, std::uint32_t least, std::vector<NodePair>& pairs) {
    std::vector<NodePair> found;
    double radius = kSearchRadius * nodes_.spacing;
    while (found.size() < least && radius < box_.sizes().norm()) {
      radius *= kWiden;
      found.clear();
      bins_.within(nodes_.at[node], radius, [&](std::uint32_t j, const Vec3& span) {
        if (j == node || !sight_.joined(node, j)) return;
        const Vec3 upwards = node < j ? span : Vec3(nodes_.at[node] - nodes_.at[j]);
        found.push_back({std::min(node, j), std::max(node, j), upwards, upwards.norm()});
      });
    }
    std::sort(found.begin(), found.end(), shorter);
    if (found.size() > least) found.resize(least);
    pairs.insert(pairs.end(), found.begin(), found.end());
  }

  const RandomNodes& nodes_;
  Sight sight_;
  PointBins bins_;
  Box3 box_;
};

}  // namespace

std::vector<NodePair> select_pairs(std::vector<NodePair> candidates, std::uint32_t nodes,
                                   double mean, std::uint32_t least) {
  std::sort(candidates.begin(), candidates.end(), shorter);
  const auto wanted = static_cast<std::size_t>(std::llround(mean * nodes / 2));
  Selection selection(candidates, nodes, least);
  selection.join_nearest();
  selection.join_shortest_until(wanted);
  selection.drop_longest_until(wanted);
  return selection.sorted();
}

std::vector<NodePair> choose_pairs(const MaterialGrid& grid, const RandomNodes& nodes,
                                   const Box3& box, double mean, std::uint32_t least) {
  return select_pairs(Search(grid, nodes, box).run(least),
                      static_cast<std::uint32_t>(nodes.at.size()), mean, least);
}

}  // namespace springlod::voxelize
