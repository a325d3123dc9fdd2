#include "sim/contact/contact_schedule.hpp"

#include <cmath>
#include <random>
#include <vector>

#include <catch2/catch.hpp>

using namespace springlod::sim;

TEST_CASE("The schedule checks a point in every step in which it is near, and seldom far away") {
  constexpr std::uint32_t kPoints = 300;
  constexpr int kSteps = 2000;
  std::mt19937 random(1);
  std::uniform_real_distribution<double> height(0, 1);
  std::uniform_real_distribution<double> move(-1, 1);
  std::vector<double> z(kPoints);
  for (double& of_point : z) of_point = height(random);
  ContactSchedule schedule;
  schedule.restart(kPoints, 0.01);
  double travel = 0;
  std::uint64_t checks = 0;
  for (int step = 0; step < kSteps; ++step) {
    const double largest = 2e-3;
    for (double& of_point : z) of_point = std::abs(of_point + largest * move(random));
    travel += largest;
    std::vector<bool> checked(kPoints, false);
    schedule.check(travel, [&](std::uint32_t point) {
      REQUIRE_FALSE(checked[point]);
      checked[point] = true;
      ++checks;
      return z[point];
    });
    for (std::uint32_t p = 0; p < kPoints; ++p)
      if (z[p] <= 0) REQUIRE(checked[p]);
    if (step == 0) CHECK(checks == kPoints);
  }
  CHECK(checks < kSteps * kPoints / 20);
  schedule.restart(kPoints, 0.01);
  checks = 0;
  schedule.check(travel, [&](std::uint32_t) {
    ++checks;
    return 1.0;
  });
  CHECK(checks == kPoints);
}

TEST_CASE("A point that moves straight to the obstacle is checked before it can touch it") {
  const double speed = GENERATE(1e-4, 3e-3, 0.2);
  ContactSchedule schedule;
  schedule.restart(1, 0.01);
  double z = 1;
  double travel = 0;
  bool seen = false;
  while (z > 0) {
    z -= speed;
    travel += speed;
    seen = false;
    schedule.check(travel, [&](std::uint32_t) {
      seen = true;
      return z;
    });
  }
  CHECK(seen);
}
