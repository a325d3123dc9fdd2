#include "lod/calibration/damped_step.hpp"

#include <Eigen/Cholesky>
#include <catch2/catch.hpp>

#include "elastic/solver/random_block.hpp"

using namespace springlod;
using namespace springlod::lod;
using Rows = Eigen::SparseMatrix<double, Eigen::RowMajor>;

namespace {

/// Constraints on three neighbouring unknowns each.
Rows constraints_on(Eigen::Index count, Eigen::Index unknowns) {
  std::vector<Eigen::Triplet<double>> entries;
  for (int r = 0; r < count; ++r)
    for (int c = 0; c < 3; ++c)
      entries.emplace_back(r, (2 * r + c) % static_cast<int>(unknowns), 0.4);
  Rows rows(count, unknowns);
  rows.setFromTriplets(entries.begin(), entries.end());
  return rows;
}

}  // namespace

TEST_CASE("A step is the dense least-squares solution for residuals and active constraints") {
  constexpr Eigen::Index n = 40, r = 6, l = 15;
  const Eigen::MatrixXd jacobian = elastic::random_block(n, r, 1);
  const Eigen::VectorXd residual = 0.01 * elastic::random_block(r, 1, 2);
  const Rows constraints = constraints_on(l, n);
  const Eigen::VectorXd value = Eigen::VectorXd::Constant(l, 0.05);  // all active
  const Eigen::MatrixXd gram = jacobian.transpose() * jacobian;
  DampedNormal normal_of_residuals(gram);
  double damping = 1e-3;
  const Eigen::VectorXd d = damped_step({.jacobian = jacobian,
                                         .normal = normal_of_residuals,
                                         .residual = residual,
                                         .constraint_jacobian = constraints,
                                         .constraint_value = value,
                                         .constraint_weight = 0.7,
                                         .most_rms = 10},
                                        damping);
  CHECK(damping == 1e-3);
  const double ridge = damping * gram.diagonal().mean();
  const Eigen::MatrixXd h = 0.7 * Eigen::MatrixXd(constraints);
  const Eigen::MatrixXd normal =
      jacobian * jacobian.transpose() + h.transpose() * h + ridge * Eigen::MatrixXd::Identity(n, n);
  const Eigen::VectorXd expected =
      normal.ldlt().solve(jacobian * residual - 0.7 * (h.transpose() * value));
  CHECK((d - expected).norm() < 1e-6 * expected.norm());
}

TEST_CASE("The factors of a normal matrix are those of the damping asked for") {
  const Eigen::MatrixXd a = elastic::random_block(20, 5, 3);
  const Eigen::MatrixXd gram = a.transpose() * a;
  DampedNormal normal(gram);
  CHECK(normal.scale() == Approx(gram.diagonal().mean()));
  for (const double epsilon : {0.1, 0.1, 0.5, 0.0})
    CHECK((normal.factors(epsilon).reconstructedMatrix() - gram -
           epsilon * Eigen::MatrixXd::Identity(5, 5))
              .norm() < 1e-12);
}

TEST_CASE("The damping is raised until the step is short enough") {
  const Eigen::MatrixXd jacobian = Eigen::MatrixXd::Identity(3, 3);
  const Eigen::VectorXd residual = Eigen::VectorXd::Constant(3, 5);
  const Rows none(0, 3);
  const Eigen::VectorXd no_values;
  const Eigen::MatrixXd gram = jacobian.transpose() * jacobian;
  DampedNormal normal(gram);
  double damping = 1e-4;
  const Eigen::VectorXd d = damped_step({.jacobian = jacobian,
                                         .normal = normal,
                                         .residual = residual,
                                         .constraint_jacobian = none,
                                         .constraint_value = no_values,
                                         .most_rms = 0.2},
                                        damping);
  CHECK(damping > 1);
  CHECK(d[0] <= 0.2);
  CHECK(d[0] > 0.05);
}

TEST_CASE("A constraint violated at the point of linearization is active, even if not at d = 0") {
  const Eigen::MatrixXd jacobian = Eigen::MatrixXd::Identity(2, 1);
  const Eigen::MatrixXd gram = jacobian.transpose() * jacobian;
  DampedNormal normal(gram);
  const Eigen::VectorXd residual = Eigen::VectorXd::Zero(1);
  const Eigen::VectorXd value = Eigen::VectorXd::Constant(1, -1);
  Rows constraints(1, 2);
  constraints.insert(0, 1) = 1;
  const auto second = [&](const Eigen::VectorXd& at) {
    double damping = 1e-6;
    return damped_step({.jacobian = jacobian,
                        .normal = normal,
                        .residual = residual,
                        .constraint_jacobian = constraints,
                        .constraint_value = value,
                        .linearized_at = at,
                        .constraint_weight = 100,
                        .most_rms = 10},
                       damping)[1];
  };
  CHECK(second({}) == 0);
  CHECK(second(Eigen::VectorXd::Constant(2, 1.5)) == Approx(1).epsilon(1e-3));
}
