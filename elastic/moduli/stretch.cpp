#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include <Eigen/Cholesky>
#include <fmt/format.h>

#include "base/error.hpp"
#include "elastic/moduli.hpp"
#include "elastic/moduli/balanced_solver.hpp"
#include "elastic/stiffness.hpp"

namespace springlod::elastic {
namespace {

/// Relative residual of the solution; the moduli have about as many digits.
constexpr double kTolerance = 1e-9;
/// Lattices of 20k nodes need some hundred steps, strongly uneven ones some thousand.
constexpr Eigen::Index kMaxSteps = 50000;

struct Bar {
  Eigen::Index axis = 2;
  double low = 0;
  double high = 0;
  double end_depth = 0;  // a node within this distance of the extreme nodes belongs to an end
  double length() const { return high - low; }
  bool at_low(const Vec3& p) const { return p[axis] <= low + end_depth; }
  bool at_high(const Vec3& p) const { return p[axis] >= high - end_depth; }
};

Bar measure_bar(const MassSpringModel& model, int axis) {
  if (axis < 0 || axis > 2)
    throw InputError(fmt::format("stretch test: axis {} must be 0 (x), 1 (y) or 2 (z)", axis));
  const Box3 box = bounds(model.rest);
  Bar bar;
  bar.axis = axis;
  bar.low = box.min()[axis];
  bar.high = box.max()[axis];
  constexpr double kFlat = 1e-9;  // fraction of the size: rounding in the coordinates of one plane
  if (model.spring_count() == 0 || !(bar.length() > kFlat * box.sizes().norm()))
    throw InputError(
        fmt::format("stretch test: the model has fewer than two planes of nodes along "
                    "{}; stretch it along another axis",
                    "xyz"[axis]));
  // At most a quarter of the length each, so that the ends do not overlap.
  bar.end_depth = std::min(mean_spring_length(model) / 2, bar.length() / 4);
  return bar;
}

/// Displacement at strain 1: prescribed along the axis at the ends, solved for elsewhere.
Eigen::VectorXd solve(const Eigen::SparseMatrix<double>& stiffness, const MassSpringModel& model,
                      const Bar& bar) {
  Eigen::VectorXd u = Eigen::VectorXd::Zero(stiffness.rows());
  std::vector<Eigen::Index> free_of(static_cast<std::size_t>(u.size()), -1);
  Eigen::Index free_count = 0;
  for (std::uint32_t i = 0; i < model.node_count(); ++i) {
    const Vec3& p = model.rest[i];
    const bool held = bar.at_low(p) || bar.at_high(p);
    for (Eigen::Index d = 0; d < 3; ++d) {
      const Eigen::Index row = 3 * static_cast<Eigen::Index>(i) + d;
      // Uniform strain is prescribed at the ends, and is a good initial guess elsewhere.
      if (d == bar.axis) u[row] = p[d] - bar.low;
      if (d != bar.axis || !held) free_of[static_cast<std::size_t>(row)] = free_count++;
    }
  }

  std::vector<Eigen::Triplet<double>> entries;
  entries.reserve(static_cast<std::size_t>(stiffness.nonZeros()));
  for (Eigen::Index column = 0; column < stiffness.outerSize(); ++column)
    for (Eigen::SparseMatrix<double>::InnerIterator e(stiffness, column); e; ++e) {
      const Eigen::Index r = free_of[static_cast<std::size_t>(e.row())];
      const Eigen::Index c = free_of[static_cast<std::size_t>(e.col())];
      if (r >= 0 && c >= 0)
        entries.emplace_back(static_cast<int>(r), static_cast<int>(c), e.value());
    }
  BalancedSolver::Matrix free_stiffness(free_count, free_count);
  free_stiffness.setFromTriplets(entries.begin(), entries.end());

  const Eigen::VectorXd force = -(stiffness * u);
  Eigen::VectorXd free_force(free_count);
  for (std::size_t row = 0; row < free_of.size(); ++row)
    if (free_of[row] >= 0) free_force[free_of[row]] = force[static_cast<Eigen::Index>(row)];

  // Uniform strain is the solution already where nothing contracts (nu = 0): what is left of the
  // forces is rounding.
  constexpr double kRounding = 1e-13;
  const double largest = (stiffness.cwiseAbs() * u.cwiseAbs()).cwiseAbs().maxCoeff();
  if (!(free_force.cwiseAbs().maxCoeff() > kRounding * largest)) return u;
  // The matrix is singular (lateral rigid motions), but the forces are in equilibrium.
  const BalancedSolver solver(free_stiffness,
                              {.name = "stretch test",
                               .advice = "the stiffness of the springs may differ too much",
                               .tolerance = kTolerance,
                               .most_steps = kMaxSteps});
  const Eigen::VectorXd correction = solver.solve(free_force);
  for (std::size_t row = 0; row < free_of.size(); ++row)
    if (free_of[row] >= 0) u[static_cast<Eigen::Index>(row)] += correction[free_of[row]];
  return u;
}

/// Contraction along `across` per length over the middle half. A rotation about the axis and a
/// translation are fitted along with it.
std::optional<double> contraction(const MassSpringModel& model, const Eigen::VectorXd& u,
                                  const Bar& bar, Eigen::Index across) {
  const Eigen::Index other = 3 - bar.axis - across;
  const double middle = (bar.low + bar.high) / 2;
  Vec3 centre = Vec3::Zero();
  std::vector<std::uint32_t> nodes;
  // Slightly more than a quarter to either side, so that rounding does not split a plane of nodes.
  constexpr double kQuarter = 0.25 * (1 + 1e-9);
  for (std::uint32_t i = 0; i < model.node_count(); ++i)
    if (std::abs(model.rest[i][bar.axis] - middle) <= kQuarter * bar.length()) {
      nodes.push_back(i);
      centre += model.rest[i];
    }
  if (nodes.empty()) return std::nullopt;
  centre /= static_cast<double>(nodes.size());

  Mat3 normal = Mat3::Zero();
  Vec3 right = Vec3::Zero();
  for (const std::uint32_t i : nodes) {
    const Vec3 p = model.rest[i] - centre;
    const Vec3 row(1, p[across] / bar.length(), p[other] / bar.length());
    normal += row * row.transpose();
    right += u[3 * static_cast<Eigen::Index>(i) + across] * row;
  }
  constexpr double kNoWidth = 1e-12;  // mean square of width / length
  if (normal(1, 1) <= kNoWidth * normal(0, 0)) return std::nullopt;
  if (normal(2, 2) <= kNoWidth * normal(0, 0))
    normal(2, 2) = 1;  // flat: there is no rotation to fit
  return -normal.ldlt().solve(right)[1] / bar.length();
}

double poisson_ratio(const MassSpringModel& model, const Eigen::VectorXd& u, const Bar& bar) {
  double sum = 0;
  int count = 0;
  for (Eigen::Index across = 0; across < 3; ++across) {
    if (across == bar.axis) continue;
    if (const auto nu = contraction(model, u, bar, across)) {
      sum += *nu;
      ++count;
    }
  }
  return count > 0 ? sum / count : std::numeric_limits<double>::quiet_NaN();
}

}  // namespace

StretchResult stretch_test(const MassSpringModel& model, const StretchOptions& options) {
  const Bar bar = measure_bar(model, options.axis);
  const Eigen::SparseMatrix<double> stiffness = stiffness_matrix(model);
  const Eigen::VectorXd u = solve(stiffness, model, bar);
  const Eigen::VectorXd force = stiffness * u;

  StretchResult result;
  for (std::uint32_t i = 0; i < model.node_count(); ++i)
    if (bar.at_high(model.rest[i]))
      result.reaction += force[3 * static_cast<Eigen::Index>(i) + bar.axis];
  const double area = options.cross_section > 0 ? options.cross_section
                                                : mass_properties(model).volume / bar.length();
  result.young = result.reaction / area;
  result.poisson = poisson_ratio(model, u, bar);
  result.strain_energy = u.dot(force) / 2;
  return result;
}

}  // namespace springlod::elastic
