// Corners in the fast layouts, compared with the plain kernel and on several threads.

#include <catch2/catch.hpp>

#include "sim/fast/fast_leapfrog.hpp"
#include "sim/integrators/leapfrog.hpp"
#include "sim/integrators/step_limit.hpp"
#include "tests/sim/correction/throws.hpp"
#include "tests/sim/side_by_side.hpp"
#include "tests/sim/vector_targets.hpp"

using namespace springlod;
using namespace springlod::sim;
using namespace springlod::test;

namespace {

/// Steps from the start until some time after the first contact.
constexpr double kUntil = 0.012;  // [s]

std::uint64_t steps_until(const MassSpringModel& model, double time) {
  return static_cast<std::uint64_t>(time / (0.5 * predicted_step(model)));
}

/// A body that starts in touch with the floor.
Scenario press_scene(const MassSpringModel& model, double speed) {
  Scenario scene;
  Obstacle ground = floor(1, 0.4);
  ground.stiffness.reset();
  std::get<Plane>(ground.shape).offset = bounds(model.rest).min().z() - 1e-4;
  scene.obstacles = {ground};
  scene.start.velocity = {1, 0.5, -speed};
  scene.start.spin = {0, 0, 5};
  return scene;
}

}  // namespace

TEST_CASE("Fast steps through a hard throw are those of the plain kernel, to rounding") {
  static const LodChain chain = soft_bar(1e-3);
  const std::uint32_t level = GENERATE(0U, 1U);
  const auto layout = GENERATE(Layout::fastest, Layout::any_shape);
  const bool at_surface = GENERATE(false, true);
  const MassSpringModel& model = chain.levels[level].model;
  const Scenario scene = bar_throw(12);
  const auto skin = contacts_at(chain, level, at_surface);
  const std::uint64_t steps = steps_until(model, kUntil);
  CAPTURE(level, to_string(layout), at_surface, steps);
  const Outcome plain = after<Leapfrog>(model, scene, steps, {.skin = skin}, 1);
  REQUIRE(plain.contacts > 0);
  REQUIRE(plain.ledger.lost_corners > 0.01 * plain.ledger.total());
  REQUIRE(least_ratio(model, plain.state.x) < kCornerResists);
  const Outcome fast = after<FastLeapfrog>(
      model, scene, steps,
      {.layout = make_fast_model(model, Precision::double_precision, layout), .skin = skin}, 1);
  const double size = bounds(model.rest).sizes().norm();
  // The sweeps over contacts that share nodes depend on their order, which differs.
  const double near = at_surface && level > 0 ? 1e-3 : 1e-10;
  CHECK(largest_difference(plain.state.x, fast.state.x) < near * size);
  CHECK(largest_difference(plain.state.v, fast.state.v) < 100 * near * 12);
  CHECK(fast.contacts == plain.contacts);
  for (const auto part :
       {&LedgerEntry::kinetic, &LedgerEntry::elastic, &LedgerEntry::lost_damping,
        &LedgerEntry::lost_friction, &LedgerEntry::lost_contact, &LedgerEntry::lost_corners})
    CHECK(fast.ledger.*part ==
          Approx(plain.ledger.*part).margin(10 * near * std::abs(plain.ledger.total())));
  const Outcome single =
      after<FastLeapfrog>(model, scene, steps,
                          {.precision = Precision::single_precision,
                           .layout = make_fast_model(model, Precision::single_precision, layout),
                           .skin = skin},
                          1);
  CHECK(largest_difference(plain.state.x, single.state.x) < 1e-3 * size);
  CHECK(single.ledger.lost_corners == Approx(plain.ledger.lost_corners).epsilon(0.01));
}

TEST_CASE(
    "Corners give the same bits, however many steps are taken at once, with a ledger or not") {
  static const LodChain chain = soft_bar(1e-3);
  const std::uint32_t level = GENERATE(0U, 1U);
  const auto precision = GENERATE(Precision::single_precision, Precision::double_precision);
  const bool volumes = GENERATE(false, true);
  const MassSpringModel& model = chain.levels[level].model;
  const Scenario scene = bar_throw(12);
  const std::uint64_t steps = steps_until(model, 2 * kUntil);
  const FastOptions options{.volumes = volumes, .precision = precision};
  const Outcome one = after<FastLeapfrog>(model, scene, steps, options, 1);
  check_same_bits(one, after<FastLeapfrog>(model, scene, steps, options, 37));
  Outcome without = after<FastLeapfrog>(
      model, scene, steps, {.ledger = false, .volumes = volumes, .precision = precision}, 1000);
  without.ledger = one.ledger;
  check_same_bits(one, without);
}

TEST_CASE("Corners give the same bits on every kind of vectors") {
  static const LodChain chain = soft_bar(1e-3);
  const std::uint32_t level = GENERATE(0U, 1U);
  const auto precision = GENERATE(Precision::single_precision, Precision::double_precision);
  CAPTURE(level, to_string(precision));
  const MassSpringModel& model = chain.levels[level].model;
  const Scenario scene = bar_throw(12);
  const auto thrown = [&] {
    return after<FastLeapfrog>(model, scene, steps_until(model, kUntil), {.precision = precision},
                               37);
  };
  const Outcome best = thrown();
  REQUIRE(best.ledger.lost_corners > 0);
  hold_targets_together(thrown, check_same_bits);
}

TEST_CASE("Corners give the same bits on any number of threads", "[threaded]") {
  const bool merged = GENERATE(false, true);
  const MassSpringModel lattice = two_material_block(merged ? 41 : 33);
  MassSpringModel model = merged ? lod::simplify(lattice, {.levels = 1}).levels[1].model : lattice;
  for (double& damping : model.damping) damping = 0;  // longer steps
  REQUIRE(model.node_count() > 32'768);               // worth four threads
  const Scenario scene = press_scene(model, 20);
  constexpr std::uint64_t kFew = 8;
  for (const Precision precision : {Precision::single_precision, Precision::double_precision}) {
    CAPTURE(merged, to_string(precision));
    const std::shared_ptr<const FastModel> layout = make_fast_model(model, precision);
    const auto on = [&](std::uint32_t threads) {
      return after<FastLeapfrog>(
          model, scene, kFew, {.precision = precision, .threads = threads, .layout = layout}, 1000);
    };
    const Outcome one = on(1);
    REQUIRE(one.contacts > 100);
    REQUIRE(one.ledger.lost_corners > 0);
    REQUIRE(least_ratio(model, one.state.x) < kCornerResists);
    check_same_bits(one, on(2));
    check_same_bits(one, on(4));
  }
}
