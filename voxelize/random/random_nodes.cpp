#include "voxelize/random/random_nodes.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "base/error.hpp"
#include "base/random.hpp"
#include "model/point_bins.hpp"
#include "voxelize/index_lookup.hpp"

namespace springlod::voxelize {
namespace {

// Disk radius in spacings. A maximal set of disks of radius r has about 0.73 / r^3 points per
// volume and 0.70 / r^2 per area (saturated random packing). With these two, each node represents a
// cube or a square of one spacing.
constexpr double kInnerDisk = 0.90;
constexpr double kOuterDisk = 0.83;
// Rounds of Lloyd's relaxation. E of a periodic network with 18 ends rises by a tenth
// within 20 and no further, most of it within 5 (docs/choices.md).
constexpr int kRelaxations = 20;
// Bisections of the spacing; the error of the count is then about one node.
constexpr int kHalvings = 12;
// Factor on the disk radius if more nodes are wanted and no place is left.
constexpr double kShrink = 0.9;

/// The nodes placed so far, in bins, with a test of the distance to a new node.
class Darts {
 public:
  Darts(const Box3& box, double bin) : box_(box), bin_(bin) {
    double total = 1;
    const auto bins = [&] {
      total = 1;
      for (int d = 0; d < 3; ++d) {
        count_[d] = 1 + static_cast<std::int64_t>(box.sizes()[d] / bin_);
        total *= static_cast<double>(count_[d]);
      }
      return total;
    };
    constexpr double kMostBins = 1 << 24;
    while (bins() > kMostBins) bin_ *= 1.25;
    head_.assign(static_cast<std::size_t>(total), kNoIndex);
  }

  bool free(const Vec3& place, double radius) const {
    const auto at = bin(place);
    const auto reach = 1 + static_cast<std::int64_t>(radius / bin_);
    const auto low = [&](int d) { return std::max<std::int64_t>(0, at[d] - reach); };
    const auto high = [&](int d) { return std::min(count_[d] - 1, at[d] + reach); };
    for (std::int64_t z = low(2); z <= high(2); ++z)
      for (std::int64_t y = low(1); y <= high(1); ++y)
        for (std::int64_t x = low(0); x <= high(0); ++x)
          for (std::uint32_t i = head_[number(x, y, z)]; i != kNoIndex; i = next_[i])
            if ((places[i] - place).squaredNorm() < radius * radius) return false;
    return true;
  }

  void add(const Vec3& place) {
    const auto at = bin(place);
    std::uint32_t& head = head_[number(at[0], at[1], at[2])];
    next_.push_back(head);
    head = static_cast<std::uint32_t>(places.size());
    places.push_back(place);
  }

  std::vector<Vec3> places;

 private:
  std::array<std::int64_t, 3> bin(const Vec3& place) const {
    std::array<std::int64_t, 3> at{};
    for (int d = 0; d < 3; ++d)
      at[d] = std::clamp<std::int64_t>(static_cast<std::int64_t>((place[d] - box_.min()[d]) / bin_),
                                       0, count_[d] - 1);
    return at;
  }
  std::size_t number(std::int64_t x, std::int64_t y, std::int64_t z) const {
    return static_cast<std::size_t>((z * count_[1] + y) * count_[0] + x);
  }

  Box3 box_;
  double bin_;
  std::array<std::int64_t, 3> count_{};
  std::vector<std::uint32_t> head_;  // last node of each bin
  std::vector<std::uint32_t> next_;  // previous node of the same bin
};

std::vector<std::uint32_t> shuffled(std::size_t count, std::uint64_t seed, std::uint64_t what) {
  std::vector<std::pair<std::uint64_t, std::uint32_t>> keys(count);
  for (std::uint32_t i = 0; i < count; ++i)
    keys[i] = {split_mix(split_mix(split_mix(seed) ^ what) ^ i), i};
  std::sort(keys.begin(), keys.end());
  std::vector<std::uint32_t> order(count);
  for (std::size_t i = 0; i < count; ++i) order[i] = keys[i].second;
  return order;
}

class Placing {
 public:
  Placing(const MaterialGrid& grid, const GridSamples& samples, std::uint32_t nodes,
          std::uint64_t seed)
      : grid_(grid),
        samples_(samples),
        lookup_(grid.cells),
        nodes_(nodes),
        outer_order_(shuffled(samples.outer.size(), seed, 1)),
        inner_order_(shuffled(samples.inner.size(), seed, 2)) {}

  RandomNodes run(Progress* progress) {
    Task task(progress, "placing nodes", kHalvings + kRelaxations);
    const double spacing = fitting_spacing(task);
    throw_darts(spacing);
    result_.spacing = spacing;
    complete();
    for (int i = 0; i < kRelaxations; ++i) {
      relax_outer();
      relax_inner();
      task.advance();
    }
    return result_;
  }

 private:
  /// Number of nodes that fit at this spacing; stops above the wanted number.
  std::uint32_t throw_darts(double spacing) {
    Darts darts(samples_.box, spacing);
    result_ = {};
    const auto full = [&] { return darts.places.size() > nodes_; };
    const auto add = [&](const Vec3& place, std::uint32_t cell) {
      darts.add(place);
      result_.cell.push_back(cell);
    };
    for (const std::uint32_t i : outer_order_) {
      if (full()) break;
      if (darts.free(samples_.outer[i], kOuterDisk * spacing))
        add(samples_.outer[i], samples_.outer_cell[i]);
    }
    result_.outer = static_cast<std::uint32_t>(darts.places.size());
    for (const std::uint32_t i : inner_order_) {
      if (full()) break;
      if (darts.free(samples_.inner[i], kInnerDisk * spacing))
        add(samples_.inner[i], samples_.inner_cell[i]);
    }
    const auto found = static_cast<std::uint32_t>(darts.places.size());
    result_.at = std::move(darts.places);
    return found;
  }

  /// Corrects the number of nodes: removes the last ones, or adds some with smaller disks.
  void complete() {
    Darts darts(samples_.box, result_.spacing);
    for (const Vec3& place : result_.at) darts.add(place);
    double disk = kInnerDisk * result_.spacing;
    while (darts.places.size() < nodes_) {
      disk *= kShrink;
      for (const std::uint32_t i : inner_order_) {
        if (darts.places.size() == nodes_) break;
        if (!darts.free(samples_.inner[i], disk)) continue;
        darts.add(samples_.inner[i]);
        result_.cell.push_back(samples_.inner_cell[i]);
      }
    }
    result_.at = std::move(darts.places);
    result_.at.resize(nodes_);
    result_.cell.resize(nodes_);
    result_.outer = std::min(result_.outer, nodes_);
  }

  double fitting_spacing(Task& task) {
    double low = 0.25 * std::cbrt(samples_.volume / nodes_);  // too many nodes
    double high = samples_.box.sizes().norm();                // one node
    for (int i = 0; i < kHalvings; ++i) {
      const double middle = std::sqrt(low * high);
      (throw_darts(middle) > nodes_ ? low : high) = middle;
      task.advance();
    }
    return high;
  }

  void relax_outer() {
    const std::vector<Vec3> nodes(result_.at.begin(), result_.at.begin() + result_.outer);
    const PointBins bins(nodes, samples_.box, result_.spacing);
    const auto owner = owners(bins, samples_.outer);
    const std::vector<Vec3> middles = means(nodes, samples_.outer, owner);
    snap(middles, samples_.outer, samples_.outer_cell, owner, 0,
         std::vector<bool>(nodes.size(), true));
  }

  void relax_inner() {
    const PointBins bins(result_.at, samples_.box, result_.spacing);
    const auto owner = owners(bins, samples_.inner);
    const std::vector<Vec3> middles = means(result_.at, samples_.inner, owner);
    std::vector<bool> outside(result_.at.size(), false);
    for (std::uint32_t i = result_.outer; i < result_.at.size(); ++i) {
      const std::uint32_t cell = lookup_.find(cell_at(middles[i]));
      outside[i] = cell == kNoIndex;
      if (outside[i]) continue;
      result_.at[i] = middles[i];
      result_.cell[i] = cell;
    }
    snap(middles, samples_.inner, samples_.inner_cell, owner, result_.outer, outside);
  }

  CellIndex cell_at(const Vec3& place) const {
    const Vec3 at = (place - grid_.origin) / grid_.cell;
    CellIndex cell{};
    for (int d = 0; d < 3; ++d) cell[d] = static_cast<std::int32_t>(std::floor(at[d]));
    return cell;
  }

  static std::vector<std::uint32_t> owners(const PointBins& bins, const std::vector<Vec3>& places) {
    std::vector<std::uint32_t> owner(places.size());
    for (std::size_t i = 0; i < places.size(); ++i) owner[i] = bins.nearest(places[i]).point;
    return owner;
  }

  static std::vector<Vec3> means(const std::vector<Vec3>& nodes, const std::vector<Vec3>& places,
                                 const std::vector<std::uint32_t>& owner) {
    std::vector<Vec3> sum(nodes.size(), Vec3::Zero());
    std::vector<std::uint32_t> count(nodes.size(), 0);
    for (std::size_t i = 0; i < places.size(); ++i) {
      sum[owner[i]] += places[i] - nodes[owner[i]];
      ++count[owner[i]];
    }
    for (std::size_t n = 0; n < nodes.size(); ++n)
      sum[n] = count[n] == 0 ? nodes[n] : Vec3(nodes[n] + sum[n] / count[n]);
    return sum;
  }

  /// Moves nodes to the closest sample to their target. Only the samples owned by a node are
  /// considered; only nodes with number >= `first` and a set flag in `chosen` move.
  void snap(const std::vector<Vec3>& target, const std::vector<Vec3>& places,
            const std::vector<std::uint32_t>& cells, const std::vector<std::uint32_t>& owner,
            std::uint32_t first, const std::vector<bool>& chosen) {
    std::vector<double> best(target.size(), std::numeric_limits<double>::infinity());
    for (std::size_t i = 0; i < places.size(); ++i) {
      const std::uint32_t node = owner[i];
      if (node < first || !chosen[node]) continue;
      const double squared = (places[i] - target[node]).squaredNorm();
      if (squared >= best[node]) continue;
      best[node] = squared;
      result_.at[node] = places[i];
      result_.cell[node] = cells[i];
    }
  }

  const MaterialGrid& grid_;
  const GridSamples& samples_;
  IndexLookup lookup_;
  std::uint32_t nodes_;
  std::vector<std::uint32_t> outer_order_;
  std::vector<std::uint32_t> inner_order_;
  RandomNodes result_;
};

void sample_cell(const MaterialGrid& grid, std::uint32_t n, int parts, GridSamples& samples) {
  const Vec3 low =
      grid.origin + grid.cell * Vec3(grid.cells[n][0], grid.cells[n][1], grid.cells[n][2]);
  const double step = grid.cell / parts;
  for (int z = 0; z < parts; ++z)
    for (int y = 0; y < parts; ++y)
      for (int x = 0; x < parts; ++x) {
        samples.inner.emplace_back(low + step * Vec3(x + 0.5, y + 0.5, z + 0.5));
        samples.inner_cell.push_back(n);
      }
  samples.box.extend(low);
  samples.box.extend(low + Vec3::Constant(grid.cell));
}

void sample_face(const MaterialGrid& grid, std::uint32_t n, int axis, int side, int parts,
                 GridSamples& samples) {
  const Vec3 low =
      grid.origin + grid.cell * Vec3(grid.cells[n][0], grid.cells[n][1], grid.cells[n][2]);
  const double step = grid.cell / parts;
  for (int v = 0; v < parts; ++v)
    for (int u = 0; u < parts; ++u) {
      Vec3 place = low;
      place[axis] += side > 0 ? grid.cell : 0;
      place[(axis + 1) % 3] += step * (u + 0.5);
      place[(axis + 2) % 3] += step * (v + 0.5);
      samples.outer.push_back(place);
      samples.outer_cell.push_back(n);
      samples.outward.emplace_back(side * Vec3::Unit(axis));
    }
}

}  // namespace

GridSamples sample_grid(const MaterialGrid& grid, std::uint32_t nodes, double per_node) {
  struct Face {
    std::uint32_t cell;
    int axis, side;
  };
  const IndexLookup lookup(grid.cells);
  std::vector<Face> faces;
  for (std::uint32_t n = 0; n < grid.cells.size(); ++n)
    for (int axis = 0; axis < 3; ++axis)
      for (const int side : {-1, 1}) {
        CellIndex next = grid.cells[n];
        next[axis] += side;
        if (lookup.find(next) == kNoIndex) faces.push_back({n, axis, side});
      }
  const double per_cell = per_node * nodes / static_cast<double>(grid.cells.size());
  const int parts = std::max(1, static_cast<int>(std::lround(std::cbrt(per_cell))));
  GridSamples samples;
  samples.volume = static_cast<double>(grid.cells.size()) * std::pow(grid.cell, 3);
  samples.inner_volume = std::pow(grid.cell / parts, 3);
  // Surface nodes are at samples of the surface, so these are twice as dense along each axis.
  const int face_parts = 2 * parts;
  samples.outer_area = std::pow(grid.cell / face_parts, 2);
  for (std::uint32_t n = 0; n < grid.cells.size(); ++n) sample_cell(grid, n, parts, samples);
  for (const Face& f : faces) sample_face(grid, f.cell, f.axis, f.side, face_parts, samples);
  return samples;
}

RandomNodes place_nodes(const MaterialGrid& grid, const GridSamples& samples, std::uint32_t nodes,
                        std::uint64_t seed, Progress* progress) {
  if (samples.inner.size() < nodes)
    throw InputError(
        fmt::format("random: {} nodes do not fit the {} samples of the grid; use fewer nodes",
                    nodes, samples.inner.size()));
  return Placing(grid, samples, nodes, seed).run(progress);
}

}  // namespace springlod::voxelize
