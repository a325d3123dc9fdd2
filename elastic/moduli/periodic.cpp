#include <fmt/format.h>

#include "base/error.hpp"
#include "base/script_number.hpp"
#include "elastic/moduli.hpp"
#include "elastic/moduli/balanced_solver.hpp"

namespace springlod::elastic {
namespace {

using Strain = Eigen::Matrix<double, 6, 1>;  // xx, yy, zz, yz, zx, xy (engineering shears)

/// Lengthening of a spring for each strain: L u . strain . u.
Strain lengthening(const Vec3& u, double length) {
  Strain e;
  e << u.x() * u.x(), u.y() * u.y(), u.z() * u.z(), u.y() * u.z(), u.z() * u.x(), u.x() * u.y();
  return length * e;
}

void require_sizes(const PeriodicNetwork& n) {
  const std::size_t springs = n.a.size();
  if (n.b.size() != springs || n.span.size() != springs || n.stiffness.size() != springs)
    throw InputError(
        fmt::format("periodic network: every spring array must have {} entries", springs));
  for (std::size_t s = 0; s < springs; ++s)
    if (n.a[s] >= n.rest.size() || n.b[s] >= n.rest.size())
      throw InputError(fmt::format(
          "periodic network: spring {} refers to a node that does not exist", script_number(s)));
}

}  // namespace

PeriodicModuli periodic_stretch(const PeriodicNetwork& network) {
  require_sizes(network);
  const auto rows = 3 * static_cast<Eigen::Index>(network.rest.size());
  std::vector<Eigen::Triplet<double>> entries;
  entries.reserve(36 * network.a.size());
  const auto add_block = [&](std::uint32_t i, std::uint32_t j, const Mat3& block) {
    for (int r = 0; r < 3; ++r)
      for (int c = 0; c < 3; ++c)
        entries.emplace_back(static_cast<int>(3 * i) + r, static_cast<int>(3 * j) + c, block(r, c));
  };
  Eigen::Matrix<double, 6, 6> energy = Eigen::Matrix<double, 6, 6>::Zero();
  Eigen::Matrix<double, Eigen::Dynamic, 6> force =
      Eigen::Matrix<double, Eigen::Dynamic, 6>::Zero(rows, 6);
  double work = 0;
  for (std::size_t s = 0; s < network.a.size(); ++s) {
    const double length = network.span[s].norm();
    const Vec3 u = network.span[s] / length;
    const double k = network.stiffness[s];
    const Mat3 block = k * u * u.transpose();
    add_block(network.a[s], network.a[s], block);
    add_block(network.b[s], network.b[s], block);
    add_block(network.a[s], network.b[s], -block);
    add_block(network.b[s], network.a[s], -block);
    const Strain e = lengthening(u, length);
    energy += k * e * e.transpose();
    force.middleRows<3>(3 * static_cast<Eigen::Index>(network.a[s])) += k * u * e.transpose();
    force.middleRows<3>(3 * static_cast<Eigen::Index>(network.b[s])) -= k * u * e.transpose();
    work += k * length * length;
  }
  BalancedSolver::Matrix stiffness(rows, rows);
  stiffness.setFromTriplets(entries.begin(), entries.end());
  const BalancedSolver solver(stiffness, {.name = "periodic stretch"});
  for (int e = 0; e < 6; ++e) energy.col(e) -= force.transpose() * solver.solve(force.col(e));
  const double volume = network.box.prod();
  const Eigen::Matrix<double, 6, 6> c = energy / volume;
  const double straight = c(0, 0) + c(1, 1) + c(2, 2);
  const double crossed = c(0, 1) + c(0, 2) + c(1, 2);
  const double bulk = (straight + 2 * crossed) / 9;
  const double shear = (straight - crossed + 3 * (c(3, 3) + c(4, 4) + c(5, 5))) / 15;
  return {9 * bulk * shear / (3 * bulk + shear), (3 * bulk - 2 * shear) / (6 * bulk + 2 * shear),
          work / (6 * volume)};
}

}  // namespace springlod::elastic
