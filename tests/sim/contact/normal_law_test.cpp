#include "sim/contact/normal_law.hpp"

#include <algorithm>
#include <cmath>
#include <random>

#include <catch2/catch.hpp>

using namespace springlod::sim;

namespace {

/// 10^e with e uniform in [least, most].
double decades(std::mt19937& random, double least, double most) {
  return std::pow(10, std::uniform_real_distribution<double>(least, most)(random));
}

/// The law's force between two depths, from its definition.
double force_between(const NormalLaw::Terms& law, double start, double end) {
  const double inside = std::max(0.0, end) - std::max(0.0, start);
  const double gradient =
      end == start ? law.stiffness * std::max(0.0, end)
                   : (penalty_energy(law.stiffness, end) - penalty_energy(law.stiffness, start)) /
                         (end - start);
  return std::max(0.0, gradient + law.stiffness * law.damping * inside);
}

}  // namespace

TEST_CASE("The normal force over a step solves its equation, for any stiffness and depth") {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> depth(-1, 1);
  for (int i = 0; i < 20000; ++i) {
    const NormalLaw::Terms law{.stiffness = decades(random, -4, 8),
                               .damping = i % 2 == 0 ? 0 : decades(random, -3, 2),
                               .mobility = decades(random, -4, 2)};
    const double scale = decades(random, -6, 1);
    const double start = scale * depth(random);
    const double free = scale * depth(random);
    CAPTURE(law.stiffness, law.damping, law.mobility, start, free);
    const NormalLaw::Result step = NormalLaw(law).solve(start, free);
    REQUIRE(step.force >= 0);
    REQUIRE(step.depth == Approx(free - law.mobility * step.force).margin(1e-9 * scale));
    // Rounding of the depth, times the slope of the force.
    const double rounding = 1e-14 * scale * (1 + law.mobility * law.stiffness * (1 + law.damping));
    REQUIRE(law.mobility * step.force ==
            Approx(law.mobility * force_between(law, start, step.depth))
                .epsilon(1e-6)
                .margin(rounding));
  }
}

TEST_CASE("Without damping, a contact stores what it takes from the motion, to rounding") {
  std::mt19937 random(2);
  std::uniform_real_distribution<double> speed(-3, 3);
  for (int i = 0; i < 200; ++i) {
    const double mass = decades(random, -3, 3);
    const double step = decades(random, -4, -1);
    const NormalLaw law({.stiffness = mass / (step * step) * decades(random, -3, 6),
                         .mobility = step * step / (2 * mass)});
    double depth = -1e-3;
    double v = std::abs(speed(random)) + 0.1;  // into the obstacle
    const double before = 0.5 * mass * v * v;
    int steps = 0;
    while (v > 0 || depth > 0) {
      const NormalLaw::Result end = law.solve(depth, depth + step * v);
      v -= step * end.force / mass;
      depth = end.depth;
      REQUIRE(0.5 * mass * v * v + penalty_energy(law.stiffness(), depth) ==
              Approx(before).epsilon(1e-9));
      REQUIRE(++steps < 1000);
    }
    CHECK(v == Approx(-std::sqrt(2 * before / mass)).epsilon(1e-9));
  }
}

TEST_CASE("A very stiff contact lets a point in by almost nothing, and damping takes its speed") {
  const double step = 1e-3;
  const double mobility = step * step / 2;
  const NormalLaw stiff({.stiffness = 1e15, .mobility = mobility});
  const NormalLaw::Result in = stiff.solve(-0.5e-3, 1.5e-3);
  CHECK(in.depth > 0);
  CHECK(in.depth < 1e-6);
  const NormalLaw overdamped({.stiffness = 1e6, .damping = 1e6, .mobility = mobility});
  const NormalLaw::Result damped = overdamped.solve(0, 1e-3);
  CHECK(damped.depth < 1e-8);
  // Overdamped: the mean force stops the point at the end of the step.
  CHECK(mobility * damped.force == Approx(1e-3).epsilon(1e-3));
}
