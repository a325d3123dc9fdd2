#include "elastic/solver/dense_kernels.hpp"

#include <thread>
#include <vector>

#include <Eigen/Cholesky>
#include <catch2/catch.hpp>

#include "elastic/solver/random_block.hpp"

using namespace springlod;
using namespace springlod::elastic;

namespace {

/// Rounding error of sums of some hundred numbers near 1.
constexpr double kRounding = 1e-10;

Eigen::MatrixXd positive_definite(Eigen::Index n) {
  const Eigen::MatrixXd half = random_block(n, n, 1);
  return half * half.transpose() + static_cast<double>(n) * Eigen::MatrixXd::Identity(n, n);
}

}  // namespace

TEST_CASE("The lower triangle becomes the factor, the upper triangle is unchanged") {
  for (const Eigen::Index n : {0, 1, 48, 49, 150}) {
    const Eigen::MatrixXd a = positive_definite(n);
    Eigen::MatrixXd l = a;
    REQUIRE(factorise_lower(l));
    CHECK(l.triangularView<Eigen::StrictlyUpper>().toDenseMatrix() ==
          a.triangularView<Eigen::StrictlyUpper>().toDenseMatrix());
    l = l.triangularView<Eigen::Lower>().toDenseMatrix();
    CHECK((l * l.transpose() - a).norm() <= kRounding * a.norm());
  }
}

TEST_CASE("A pivot that is not positive is reported wherever it occurs") {
  for (const Eigen::Index bad : {0, 60, 119}) {
    Eigen::MatrixXd a = positive_definite(120);
    a(bad, bad) = -1;
    CHECK_FALSE(factorise_lower(a));
  }
}

TEST_CASE("Products and solutions agree with Eigen's for matrices, blocks and empty matrices") {
  const Eigen::MatrixXd l = positive_definite(60).llt().matrixL();
  for (const Eigen::Index rows : {0, 1, 7}) {
    const Eigen::MatrixXd b = random_block(rows, 60, 2);
    Eigen::MatrixXd x = b;
    solve_right_transposed(l, x);
    CHECK((x * l.transpose() - b).norm() <= kRounding * (1 + b.norm()));
    x = b;
    solve_right(l, x);
    CHECK((x * l - b).norm() <= kRounding * (1 + b.norm()));

    Eigen::MatrixXd c = Eigen::MatrixXd::Ones(rows, 20);
    subtract_product(b.leftCols(30), l.topLeftCorner(30, 20), c);
    const Eigen::MatrixXd product = b.leftCols(30) * l.topLeftCorner(30, 20);
    CHECK((c + product - Eigen::MatrixXd::Ones(rows, 20)).norm() <=
          kRounding * (1 + product.norm()));
    multiply_transposed(b, l.topRows(20), c);
    CHECK((c - b * l.topRows(20).transpose()).norm() <= kRounding * (1 + c.norm()));
  }
  const Eigen::MatrixXd a = random_block(9, 5, 3);
  Eigen::MatrixXd c = Eigen::MatrixXd::Zero(9, 9);
  subtract_square(a, c);
  const Eigen::MatrixXd square = a * a.transpose();
  CHECK((c + square.triangularView<Eigen::Lower>().toDenseMatrix()).norm() <= kRounding);
}

TEST_CASE("Products of several threads equal those of one thread", "[threaded]") {
  constexpr int kThreads = 4, kRounds = 2000;
  std::vector<int> wrong(kThreads, 0);
  std::vector<std::thread> threads;
  for (int t = 0; t < kThreads; ++t)
    threads.emplace_back([t, &wrong] {
      const Eigen::MatrixXd a = random_block(150, 60, static_cast<std::uint64_t>(t));
      Eigen::MatrixXd first(150, 150);
      multiply_transposed(a, a, first);
      Eigen::MatrixXd again(150, 150);
      for (int round = 0; round < kRounds; ++round) {
        multiply_transposed(a, a, again);
        if (again != first) ++wrong[static_cast<std::size_t>(t)];
      }
    });
  for (std::thread& thread : threads) thread.join();
  CHECK(wrong == std::vector<int>(kThreads, 0));
}
