#include "sim/fast/fast_watch.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include <catch2/catch.hpp>

#include "sim/fast/fast_leapfrog.hpp"
#include "sim/integrators/step_limit.hpp"
#include "tests/sim/correction/throws.hpp"
#include "tests/sim/side_by_side.hpp"

using namespace springlod;
using namespace springlod::sim;
using namespace springlod::test;

namespace {

constexpr std::uint64_t kMany = 100'000;  // steps

const MassSpringModel& bar() {
  static const LodChain chain = soft_bar(1e-3);
  return chain.levels[0].model;
}

struct Watched {
  Watched(const Scenario& of_scene, Layout layout)
      : scene(of_scene),
        body(bar(), scene, initial_state(bar(), scene.start), 0.5 * predicted_step(bar()),
             {.layout = make_fast_model(bar(), Precision::double_precision, layout)}) {
    body.prepare();
  }

  Scenario scene;
  FastLeapfrog body;
};

double largest_strain(const std::vector<Vec3>& x) {
  double most = 0;
  for (std::uint32_t s = 0; s < bar().spring_count(); ++s) {
    const double length = (x[bar().b[s]] - x[bar().a[s]]).norm();
    most = std::max(most, std::abs(length / bar().rest_length[s] - 1));
  }
  return most;
}

}  // namespace

TEST_CASE("advance() returns in the step in which a node becomes too fast") {
  const auto layout = GENERATE(Layout::fastest, Layout::any_shape);
  Scenario scene;
  scene.duration = 10;
  Watched fall(scene, layout);
  fall.body.watch({.speed = 2});
  fall.body.advance(kMany);
  const double step = fall.body.step();
  const auto expected = static_cast<std::uint64_t>(std::ceil(2 / (9.81 * step) - 0.5));
  CHECK(fall.body.stopped());
  CHECK(std::abs(static_cast<double>(fall.body.step_number()) - static_cast<double>(expected)) <=
        1);
  // Without a new limit it returns after each step; with one it goes on.
  const std::uint64_t number = fall.body.step_number();
  fall.body.advance(10);
  CHECK(fall.body.step_number() == number + 1);
  fall.body.watch({});
  fall.body.advance(10);
  CHECK_FALSE(fall.body.stopped());
  CHECK(fall.body.step_number() == number + 11);
}

TEST_CASE("advance() returns within a few steps of a strain beyond the limit, and never before") {
  const auto layout = GENERATE(Layout::fastest, Layout::any_shape);
  const double limit = GENERATE(0.1, 0.25, 0.4);
  CAPTURE(to_string(layout), limit);
  Watched every(bar_throw(8), layout);
  while (largest_strain(every.body.positions()) <= limit) every.body.advance(1);
  const std::uint64_t exceeded = every.body.step_number();
  Watched watched(bar_throw(8), layout);
  watched.body.watch({.strain = limit});
  watched.body.advance(kMany);
  CHECK(watched.body.stopped());
  CHECK(watched.body.step_number() >= exceeded);
  CHECK(watched.body.step_number() < exceeded + 4);
  CHECK(largest_strain(watched.body.positions()) > limit);
}

TEST_CASE("advance() returns in the step in which a corner near inversion changes too much") {
  const auto layout = GENERATE(Layout::fastest, Layout::any_shape);
  const double limit = 0.02;
  Watched every(bar_throw(12), layout);
  double change = 0;
  while (change <= limit) {
    every.body.advance(1);
    change = every.body.take_corner_change();
    CHECK(every.body.take_corner_change() == 0);
  }
  Watched watched(bar_throw(12), layout);
  watched.body.watch({.corner_change = limit});
  watched.body.advance(kMany);
  CHECK(watched.body.stopped());
  CHECK(watched.body.step_number() == every.body.step_number());
  CHECK(watched.body.take_corner_change() == change);
}

TEST_CASE("Watching a body does not change a bit of its motion") {
  const auto layout = GENERATE(Layout::fastest, Layout::any_shape);
  Watched alone(bar_throw(12), layout);
  alone.body.advance(150);
  Watched watched(bar_throw(12), layout);
  std::uint64_t returns = 0;
  while (watched.body.step_number() < 150) {
    watched.body.watch({.speed = 12.5, .strain = 0.3, .corner_change = 0.02});
    watched.body.advance(150 - watched.body.step_number());
    watched.body.take_corner_change();
    ++returns;
  }
  CHECK(returns > 10);
  CHECK((watched.body.state().x == alone.body.state().x));
  CHECK((watched.body.state().v == alone.body.state().v));
  CHECK(watched.body.ledger_entry().total() == alone.body.ledger_entry().total());
}
