#include "elastic/solver/sparse_cholesky.hpp"

#include <Eigen/Cholesky>
#include <catch2/catch.hpp>

#include "elastic/solver/random_block.hpp"
#include "elastic/stiffness.hpp"
#include "tests/elastic/elastic_samples.hpp"
#include "tests/support/models.hpp"

namespace springlod::elastic {
namespace {

Eigen::SparseMatrix<double> shifted_stiffness(const MassSpringModel& m, double shift) {
  Eigen::SparseMatrix<double> k = stiffness_matrix(m);
  for (Eigen::Index i = 0; i < k.rows(); ++i) k.coeffRef(i, i) += shift;
  return k;
}

TEST_CASE("solve() solves the system of the matrix") {
  const std::uint64_t seed = GENERATE(1U, 2U);
  const int n = GENERATE(2, 4, 7);
  const MassSpringModel m = test::random_model(seed, n);
  const auto matrix = shifted_stiffness(m, 10);
  const SparseCholesky factor(matrix, m.rest);
  REQUIRE(factor.positive());
  const Eigen::MatrixXd b = random_block(matrix.rows(), 5, seed);
  const Eigen::MatrixXd expected = Eigen::MatrixXd(matrix).llt().solve(b);
  CHECK((factor.solve(b) - expected).norm() < 1e-12 * expected.norm());
  // One column at a time.
  CHECK((factor.solve(b.col(2)) - expected.col(2)).norm() < 1e-12 * expected.norm());
}

TEST_CASE("Disconnected bodies are solved in one system") {
  const MassSpringModel m =
      test::side_by_side(test::box_lattice(5, 5, 5), test::box_lattice(4, 5, 6), {0.5, 0.5, 0.5});
  const auto matrix = shifted_stiffness(m, 1);
  const SparseCholesky factor(matrix, m.rest);
  REQUIRE(factor.positive());
  const Eigen::MatrixXd b = random_block(matrix.rows(), 1, 1);
  CHECK((matrix * factor.solve(b) - b).norm() < 1e-12 * b.norm());
}

TEST_CASE("A matrix that is not positive definite is reported") {
  const MassSpringModel m = test::random_model(3, 5);
  CHECK_FALSE(SparseCholesky(shifted_stiffness(m, -1), m.rest).positive());
}

}  // namespace
}  // namespace springlod::elastic
