#include "lod/calibration/bound_schedule.hpp"

#include <cmath>

#include <catch2/catch.hpp>

using namespace springlod::lod;

namespace {

constexpr ErrorRatios kWithin{0.9, 0.5, 0.5, 0.5, 0}, kOutside{1.5, 0.5, 0.5, 0.5, 0};

/// A schedule for omega_max = 1 rad/s whose bound is 10 rad2/s2.
BoundSchedule schedule() {
  BoundSchedule made(1);
  made.state.bound = 10;
  return made;
}

}  // namespace

TEST_CASE("The bound falls with each level within tolerance, the slower the closer its frequency") {
  BoundSchedule bounds = schedule();
  REQUIRE(bounds.next({.frequency = 2, .node_bound = 10, .merit = 1, .ratios = kWithin}));
  CHECK(bounds.state.bound == Approx(8));
  CHECK(bounds.state.within == 10);
  REQUIRE(bounds.next({.frequency = 1.05, .node_bound = 8, .merit = 1, .ratios = kWithin}));
  CHECK(bounds.state.bound == Approx(8 / (1.05 * 1.05)));
}

TEST_CASE("The bound stays close enough to the stiffest node that few nodes are constrained") {
  BoundSchedule bounds = schedule();
  REQUIRE(bounds.next({.frequency = 2, .node_bound = 20, .merit = 1, .ratios = kWithin}));
  CHECK(bounds.state.bound == Approx(0.68 * 20));
}

TEST_CASE("A level outside tolerance keeps its bound while F falls") {
  BoundSchedule bounds = schedule();
  bounds.state.within = 12.5;
  for (const double merit : {1.0, 0.9, 0.8, 0.7})
    REQUIRE(bounds.next({.frequency = 2, .node_bound = 10, .merit = merit, .ratios = kOutside}));
  CHECK(bounds.state.bound == 10);
}

TEST_CASE("Half of a decrease that a level does not follow is taken back, then the fit ends") {
  BoundSchedule bounds = schedule();
  bounds.state.within = 12.5;
  const SteppedLevel stuck{.frequency = 2, .node_bound = 10, .merit = 1, .ratios = kOutside};
  for (int step = 0; step < 3; ++step) REQUIRE(bounds.next(stuck));
  CHECK(bounds.state.bound == Approx(std::sqrt(125)));
  REQUIRE(bounds.next(stuck));
  REQUIRE(bounds.next(stuck));
  CHECK_FALSE(bounds.next(stuck));
}

TEST_CASE("A level that is never within tolerance gets slack for what exceeds it, once F settles") {
  BoundSchedule bounds = schedule();
  const SteppedLevel stuck{.frequency = 2, .node_bound = 10, .merit = 1, .ratios = kOutside};
  for (int step = 0; step < 3; ++step) REQUIRE(bounds.next(stuck));
  CHECK(bounds.state.slack[0] == Approx(1.1 * 1.5));
  CHECK(bounds.state.slack[1] == 1);
  CHECK(bounds.state.bound == Approx(8));
}

TEST_CASE("A level whose frequency is low enough gets two more steps with the same bound") {
  BoundSchedule bounds = schedule();
  const SteppedLevel reached{.frequency = 0.99, .node_bound = 10, .merit = 1, .ratios = kWithin};
  REQUIRE(bounds.next(reached));
  REQUIRE(bounds.next(reached));
  CHECK_FALSE(bounds.next(reached));
  CHECK(bounds.state.bound == 10);
}
