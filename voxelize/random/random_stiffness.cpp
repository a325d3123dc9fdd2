#include "voxelize/random/random_stiffness.hpp"

#include <algorithm>

#include <Eigen/QR>

namespace springlod::voxelize {
namespace {

// Bounds of the weight of a spring: A cannot compensate for directions with hardly any springs.
constexpr double kLeastShare = 0.2;
constexpr double kMostShare = 5;

/// xx, yy, zz, yz, zx, xy of a symmetric tensor.
using Symmetric = Eigen::Matrix<double, 6, 1>;

Symmetric outer_product(const Vec3& u) {
  Symmetric t;
  t << u.x() * u.x(), u.y() * u.y(), u.z() * u.z(), u.y() * u.z(), u.z() * u.x(), u.x() * u.y();
  return t;
}

/// u A u, with the off-diagonal entries of A doubled: they occur twice in the tensor.
double quadratic(const Symmetric& doubled, const Vec3& u) {
  return doubled.dot(outer_product(u));
}

/// A of each node, with its off-diagonal entries doubled: the smallest that makes sum (1 + u A u)
/// L^2 u u^T a multiple of the unit tensor.
std::vector<Symmetric> share_tensors(const std::vector<NodePair>& pairs, std::size_t nodes) {
  struct Sums {
    Symmetric fabric = Symmetric::Zero();
    Eigen::Matrix<double, 6, 6> by_a = Eigen::Matrix<double, 6, 6>::Zero();
  };
  std::vector<Sums> sums(nodes);
  for (const NodePair& pair : pairs) {
    const Symmetric uu = outer_product(pair.span / pair.length);
    const double squared = pair.length * pair.length;
    for (const std::uint32_t n : {pair.a, pair.b}) {
      sums[n].fabric += squared * uu;
      sums[n].by_a += squared * uu * uu.transpose();
    }
  }
  std::vector<Symmetric> tensors(nodes);
  for (std::size_t n = 0; n < sums.size(); ++n) {
    Symmetric even = Symmetric::Zero();
    even.head<3>().setConstant(sums[n].fabric.head<3>().sum() / 3);
    tensors[n] = sums[n].by_a.completeOrthogonalDecomposition().solve(even - sums[n].fabric);
  }
  return tensors;
}

}  // namespace

std::vector<double> unit_stiffness(const std::vector<NodePair>& pairs,
                                   const std::vector<double>& volume) {
  const std::vector<Symmetric> tensors = share_tensors(pairs, volume.size());
  const auto share = [&](std::uint32_t n, const NodePair& pair) {
    return std::clamp(1 + quadratic(tensors[n], pair.span / pair.length), kLeastShare, kMostShare);
  };
  std::vector<double> squares(volume.size(), 0);
  for (const NodePair& pair : pairs)
    for (const std::uint32_t n : {pair.a, pair.b})
      squares[n] += share(n, pair) * pair.length * pair.length;
  std::vector<double> stiffness;
  stiffness.reserve(pairs.size());
  for (const NodePair& pair : pairs) {
    double k = 0;
    for (const std::uint32_t n : {pair.a, pair.b}) k += 6 * volume[n] * share(n, pair) / squares[n];
    stiffness.push_back(k);
  }
  return stiffness;
}

}  // namespace springlod::voxelize
