#include "voxelize/random/random_periodic.hpp"

#include <cmath>

#include <fmt/format.h>

#include "base/error.hpp"
#include "base/random.hpp"
#include "model/point_bins.hpp"
#include "voxelize/random/random_springs.hpp"
#include "voxelize/random/random_stiffness.hpp"

namespace springlod::voxelize {
namespace {

constexpr std::uint32_t kLeastNodes = 100;
/// Candidates for each node; the one farthest from the existing nodes is taken.
constexpr std::uint32_t kCandidates = 10;
constexpr double kSamplesPerNode = 60;
/// Search radius in spacings: it contains twice as many neighbours as a node needs.
constexpr double kSearchRadius = 2.0;

Vec3 shortest(Vec3 offset) {
  for (double& x : offset) x -= std::round(x);
  return offset;
}

std::vector<Vec3> best_candidates(std::uint32_t count, std::uint64_t seed) {
  RandomStream random(seed);
  std::vector<Vec3> nodes;
  for (std::uint32_t i = 0; i < count; ++i) {
    Vec3 best = Vec3::Zero();
    double most = -1;
    for (std::uint32_t c = 0; c < kCandidates; ++c) {
      Vec3 place;
      for (double& x : place) x = random.unit();
      double nearest = 3;
      for (const Vec3& node : nodes)
        nearest = std::min(nearest, shortest(node - place).squaredNorm());
      if (nearest <= most) continue;
      most = nearest;
      best = place;
    }
    nodes.push_back(best);
  }
  return nodes;
}

class UnitBox {
 public:
  explicit UnitBox(std::uint32_t nodes)
      : spacing_(1 / std::cbrt(nodes)), parts_(std::lround(std::cbrt(kSamplesPerNode * nodes))) {}

  PointBins bins(const std::vector<Vec3>& nodes) const {
    return {nodes, box_, spacing_, PointBins::Edges::periodic};
  }
  double spacing() const { return spacing_; }

  /// Moves each node to the centroid of its Voronoi cell. Returns the volumes of the cells.
  std::vector<double> relax(std::vector<Vec3>& nodes) const {
    std::vector<Vec3> sum(nodes.size(), Vec3::Zero());
    std::vector<double> count(nodes.size(), 0);
    const PointBins near = bins(nodes);
    for (long z = 0; z < parts_; ++z)
      for (long y = 0; y < parts_; ++y)
        for (long x = 0; x < parts_; ++x) {
          const Vec3 cell(static_cast<double>(x), static_cast<double>(y), static_cast<double>(z));
          const PointBins::Near at =
              near.nearest((cell + Vec3::Constant(0.5)) / static_cast<double>(parts_));
          sum[at.point] += at.offset;
          count[at.point] += 1;
        }
    const double all = std::pow(static_cast<double>(parts_), 3);
    for (std::size_t n = 0; n < nodes.size(); ++n) {
      if (count[n] > 0) nodes[n] += sum[n] / count[n];
      for (double& x : nodes[n]) x -= std::floor(x);
      count[n] /= all;
    }
    return count;
  }

 private:
  Box3 box_{Vec3::Zero(), Vec3::Ones()};
  double spacing_;
  long parts_;
};

}  // namespace

elastic::PeriodicNetwork build_periodic_random(const PeriodicRandomOptions& options) {
  if (options.nodes < kLeastNodes)
    throw InputError(fmt::format("periodic random network: {} nodes; there must be at least {}",
                                 options.nodes, kLeastNodes));
  const UnitBox box(options.nodes);
  elastic::PeriodicNetwork network;
  network.rest = best_candidates(options.nodes, options.seed);
  for (std::uint32_t i = 0; i < options.relaxations; ++i) box.relax(network.rest);
  std::vector<Vec3> next = network.rest;
  const std::vector<double> volume = box.relax(next);

  std::vector<NodePair> candidates;
  const PointBins bins = box.bins(network.rest);
  for (std::uint32_t i = 0; i < options.nodes; ++i)
    bins.within(network.rest[i], kSearchRadius * box.spacing(),
                [&](std::uint32_t j, const Vec3& span) {
                  if (j > i) candidates.push_back({i, j, span, span.norm()});
                });
  const std::vector<NodePair> pairs =
      select_pairs(std::move(candidates), options.nodes, options.ends, options.least_ends);
  for (const NodePair& pair : pairs) {
    network.a.push_back(pair.a);
    network.b.push_back(pair.b);
    network.span.push_back(pair.span);
  }
  network.stiffness = unit_stiffness(pairs, volume);
  return network;
}

}  // namespace springlod::voxelize
