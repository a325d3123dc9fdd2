#include "lod/merging/rigidity.hpp"

#include <cmath>
#include <random>

#include <Eigen/Eigenvalues>
#include <catch2/catch.hpp>

#include "tests/support/models.hpp"

using namespace springlod;
using namespace springlod::lod;

TEST_CASE("Rigidity compares the eigenvalues of sum k u u^T") {
  Rigidity node;
  CHECK(node.springs() == 0);
  CHECK(node.at_least(1e-9));           // 0 is at least 0
  node.add_spring({2, 0, 0}, 2 * 100);  // k = 100 along x
  node.add_spring({0, -1, 0}, 50);
  CHECK_FALSE(node.at_least(1e-9));
  node.add_spring({0, 0, 0.5}, 0.5 * 10);
  node.add_spring({0, 0, 0}, 1);  // length 0: counted, adds no stiffness
  CHECK(node.springs() == 4);
  CHECK(node.at_least(0.0999));
  CHECK_FALSE(node.at_least(0.1001));
}

TEST_CASE("The determinant test agrees with the eigenvalues") {
  std::mt19937_64 random(5);
  int sound = 0;
  int flat = 0;
  for (int trial = 0; trial < 20000; ++trial) {
    // Directions from isotropic to nearly planar and nearly collinear.
    const Vec3 extent(1, std::pow(10, -3 * test::uniform(random)),
                      std::pow(10, -3 * test::uniform(random)));
    Rigidity node;
    Mat3 tensor = Mat3::Zero();
    for (int s = 0; s < 5; ++s) {
      const Vec3 d = extent.cwiseProduct(
          Vec3(test::uniform(random), test::uniform(random), test::uniform(random)) -
          Vec3::Constant(0.5));
      node.add_spring(d, 100 * d.norm());
      tensor += 100 * d.normalized() * d.normalized().transpose();
    }
    const Vec3 values = Eigen::SelfAdjointEigenSolver<Mat3>(tensor).eigenvalues();
    for (const double ratio : {1e-4, 1e-3, 1e-2, 0.1}) {
      if (std::abs(values[0] / values[2] / ratio - 1) < 1e-3)
        continue;  // undecided within rounding
      const bool expected = values[0] >= ratio * values[2];
      REQUIRE(node.at_least(ratio) == expected);
      ++(expected ? sound : flat);
    }
  }
  CHECK(sound > 1000);
  CHECK(flat > 1000);
}
