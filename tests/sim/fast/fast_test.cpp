// Fast layouts compared with the plain kernel.

#include <memory>

#include <catch2/catch.hpp>

#include "base/error.hpp"
#include "elastic/stable_step.hpp"
#include "lod/build.hpp"
#include "sim/contact/contact_skin.hpp"
#include "sim/fast/fast_leapfrog.hpp"
#include "sim/fast/rows/row_layout.hpp"
#include "sim/integrators/leapfrog.hpp"
#include "sim/integrators/step_limit.hpp"
#include "sim/run.hpp"
#include "tests/sim/side_by_side.hpp"
#include "tests/sim/vector_targets.hpp"

using namespace springlod;
using namespace springlod::sim;
using namespace springlod::test;

namespace {

constexpr std::uint64_t kSteps = 300;

}  // namespace

TEST_CASE("Fast steps are those of the plain kernel, to rounding, whatever the layout") {
  const MassSpringModel lattice = two_material_block(9);
  const bool merged = GENERATE(false, true);
  const MassSpringModel model =
      merged ? lod::simplify(lattice, {.levels = 1}).levels[1].model : lattice;
  const Scenario scene = rough_scene(model);
  const Outcome plain = after<Leapfrog>(model, scene, kSteps, {}, 1);
  REQUIRE(plain.contacts > 0);
  REQUIRE(plain.ledger.lost_friction > 0);
  REQUIRE(plain.ledger.lost_damping > 0);
  const double size = bounds(model.rest).sizes().norm();
  const double speed = 3;  // [m/s], about that of the start

  const Outcome fast = after<FastLeapfrog>(model, scene, kSteps, {}, 1);
  CHECK(largest_difference(plain.state.x, fast.state.x) < 1e-9 * size);
  CHECK(largest_difference(plain.state.v, fast.state.v) < 1e-8 * speed);
  CHECK(fast.contacts == plain.contacts);
  CHECK(fast.first_contact.value() == Approx(plain.first_contact.value()));
  const double energy = plain.ledger.total();
  for (const auto part :
       {&LedgerEntry::kinetic, &LedgerEntry::elastic, &LedgerEntry::gravity, &LedgerEntry::contact,
        &LedgerEntry::lost_damping, &LedgerEntry::lost_friction, &LedgerEntry::lost_contact})
    CHECK(fast.ledger.*part == Approx(plain.ledger.*part).margin(1e-8 * std::abs(energy)));

  const Outcome single =
      after<FastLeapfrog>(model, scene, kSteps, {.precision = Precision::single_precision}, 1);
  CHECK(largest_difference(plain.state.x, single.state.x) < 1e-4 * size);
  CHECK(largest_difference(plain.state.x, single.state.x) > 0);
  CHECK(single.ledger.total() == Approx(energy).epsilon(1e-3));
}

TEST_CASE("Fast steps of bodies of many blocks are those of the plain kernel") {
  const int side = GENERATE(25, 33);  // block sizes are multiples neither of a line nor of a layer
  const bool merged = GENERATE(false, true);
  const MassSpringModel lattice = two_material_block(side);
  const MassSpringModel model =
      merged ? lod::simplify(lattice, {.levels = 1}).levels[1].model : lattice;
  const Scenario scene = rough_scene(model);
  constexpr std::uint64_t kFew = 20;
  const Outcome plain = after<Leapfrog>(model, scene, kFew, {}, 1);
  const Outcome fast = after<FastLeapfrog>(model, scene, kFew, {}, 1000);
  const double size = bounds(model.rest).sizes().norm();
  CHECK(largest_difference(plain.state.x, fast.state.x) < 1e-12 * size);
  CHECK(fast.contacts == plain.contacts);
}

TEST_CASE("Fast steps are those of the plain kernel on every kind of vectors") {
  const bool merged = GENERATE(false, true);
  const auto precision = GENERATE(Precision::single_precision, Precision::double_precision);
  const MassSpringModel lattice = two_material_block(9);
  const MassSpringModel model =
      merged ? lod::simplify(lattice, {.levels = 1}).levels[1].model : lattice;
  const Scenario scene = rough_scene(model);
  constexpr std::uint64_t kFew = 50;
  const Outcome plain = after<Leapfrog>(model, scene, kFew, {}, 1);
  const double size = bounds(model.rest).sizes().norm();
  const double near = precision == Precision::double_precision ? 1e-11 : 1e-6;
  on_each_target([&] {
    const Outcome fast = after<FastLeapfrog>(model, scene, kFew, {.precision = precision}, 1000);
    CHECK(largest_difference(plain.state.x, fast.state.x) < near * size);
  });
}

TEST_CASE("Fast steps give the same bits on every kind of vectors that fuses products or not") {
  const double soft = GENERATE(as<double>(), kSpringPoisson, 0.45, -0.1);
  const bool merged = GENERATE(false, true);
  const auto precision = GENERATE(Precision::single_precision, Precision::double_precision);
  CAPTURE(soft, merged, precision);
  const MassSpringModel lattice = two_material_block(9, soft);
  const MassSpringModel model =
      merged ? lod::simplify(lattice, {.levels = 1}).levels[1].model : lattice;
  const Scenario scene = rough_scene(model);
  const auto run_it = [&] {
    return after<FastLeapfrog>(model, scene, kSteps, {.precision = precision}, 37);
  };
  const Outcome best = run_it();
  REQUIRE(best.contacts > 0);
  REQUIRE(best.ledger.lost_friction > 0);
  hold_targets_together(run_it, check_same_bits);
}

TEST_CASE("Fast steps give the same bits, however many are taken at once, with a ledger or not") {
  const MassSpringModel lattice = two_material_block(7);
  const bool merged = GENERATE(false, true);
  const auto precision = GENERATE(Precision::single_precision, Precision::double_precision);
  const MassSpringModel model =
      merged ? lod::simplify(lattice, {.levels = 1}).levels[1].model : lattice;
  const Scenario scene = rough_scene(model);
  const FastOptions with_ledger{.precision = precision};
  const Outcome one = after<FastLeapfrog>(model, scene, kSteps, with_ledger, 1);
  check_same_bits(one, after<FastLeapfrog>(model, scene, kSteps, with_ledger, 37));
  check_same_bits(one, after<FastLeapfrog>(model, scene, kSteps, with_ledger, 1000));
  Outcome without =
      after<FastLeapfrog>(model, scene, kSteps, {.ledger = false, .precision = precision}, 1000);
  without.ledger = one.ledger;
  check_same_bits(one, without);
}

TEST_CASE("Fast steps give the same bits on any number of threads", "[threaded]") {
  const bool merged = GENERATE(false, true);
  const auto precision = GENERATE(Precision::single_precision, Precision::double_precision);
  const MassSpringModel lattice = two_material_block(merged ? 38 : 31);
  const MassSpringModel model =
      merged ? lod::simplify(lattice, {.levels = 1}).levels[1].model : lattice;
  REQUIRE(model.node_count() > 24'000);  // worth three threads
  const Scenario scene = rough_scene(model);
  constexpr std::uint64_t kFew = 70;  // includes a change of the frame
  const std::shared_ptr<const FastModel> layout = make_fast_model(model, precision);
  const auto on = [&](std::uint32_t threads) {
    return after<FastLeapfrog>(
        model, scene, kFew, {.precision = precision, .threads = threads, .layout = layout}, 1000);
  };
  const Outcome one = on(1);
  check_same_bits(one, on(2));
  check_same_bits(one, on(3));
}

TEST_CASE("A lattice laid out as any shape moves as it does in rows, to rounding") {
  const MassSpringModel model = two_material_block(9);
  const Scenario scene = rough_scene(model);
  constexpr std::uint64_t kFew = 50;
  const auto in = [&](Layout layout) {
    const FastOptions options{.layout =
                                  make_fast_model(model, Precision::double_precision, layout)};
    return after<FastLeapfrog>(model, scene, kFew, options, 1000);
  };
  const Outcome rows = in(Layout::fastest);
  const Outcome quads = in(Layout::any_shape);
  CHECK(rows.state.x != quads.state.x);  // different order of summation: the kernels differ
  CHECK(largest_difference(rows.state.x, quads.state.x) <
        1e-11 * bounds(model.rest).sizes().norm());
}

TEST_CASE("Bodies of one layout do not disturb each other") {
  const MassSpringModel model = two_material_block(5);
  const Scenario scene = rough_scene(model);
  const std::shared_ptr<const FastModel> layout =
      make_fast_model(model, Precision::double_precision);
  const double step = 0.5 * predicted_step(model);
  const State start = initial_state(model, scene.start);
  FastLeapfrog first(model, scene, start, step, {.layout = layout});
  FastLeapfrog second(model, scene, start, step, {.layout = layout});
  first.prepare();
  second.prepare();
  first.advance(50);
  second.advance(20);
  second.advance(30);
  CHECK(first.state().x == second.state().x);
}

TEST_CASE("A fast run may change its step: same path, ledger closed") {
  const MassSpringModel model = two_material_block(5);
  const Scenario scene = rough_scene(model);
  const double step = 0.5 * predicted_step(model);
  const State start = initial_state(model, scene.start);
  FastLeapfrog steady(model, scene, start, step, {});
  FastLeapfrog changing(model, scene, start, step, {});
  steady.prepare();
  changing.prepare();
  const double energy = changing.ledger_entry().total();
  steady.advance(300);
  for (int i = 0; i < 3; ++i) {
    changing.advance(60);
    REQUIRE(changing.change_step(step / 2));
    changing.advance(80);
    REQUIRE(changing.change_step(step));
  }
  CHECK(changing.step_number() == 3 * 140);
  CHECK(changing.time() == Approx(steady.time()));
  // Shorter steps are more accurate, so the paths differ by the time-step error.
  CHECK(largest_difference(steady.state().x, changing.state().x) <
        1e-3 * bounds(model.rest).sizes().norm());
  CHECK(changing.ledger_entry().lost_switch != 0);
  CHECK(changing.ledger_entry().total() == Approx(energy).epsilon(2e-3));
  CHECK(steady.ledger_entry().total() == Approx(energy).epsilon(2e-3));
}

TEST_CASE("Bodies past the middle of a thin box stay on their side of it when the step changes") {
  const MassSpringModel model = two_material_block(5);
  const Box3 box = bounds(model.rest);
  Scenario scene;
  scene.gravity = Vec3::Zero();
  scene.start.velocity = {0, 0, -1};
  const double half = 0.01;
  Obstacle plate;
  plate.name = "plate";
  plate.friction = 0;
  // The plate would stop a rigid body at a depth of three thicknesses, m v^2 = kappa A d^2: far
  // beyond its middle.
  const double face = box.sizes().x() * box.sizes().y();
  plate.stiffness = mass_properties(model).mass / (face * std::pow(3 * 2 * half, 2));
  plate.shape = SolidBox{.center = box.center() - Vec3(0, 0, 0.5 * box.sizes().z() + 1.1 * half),
                         .half_size = {10, 10, half},
                         .rotation = Mat3::Identity()};
  scene.obstacles = {plate};
  const double step = 0.5 * predicted_step(model);
  const State start = initial_state(model, scene.start);
  LodChain chain;
  chain.levels.push_back({model, identity_groups(model.node_count()), "base"});
  const auto skin = std::make_shared<const ContactSkin>(contact_skin(chain, 0));
  for (const auto& touches : {std::shared_ptr<const ContactSkin>{}, skin}) {
    CAPTURE(touches != nullptr);
    FastLeapfrog stepper(model, scene, start, step, {.skin = touches});
    stepper.prepare();
    const double middle = box.min().z() - 1.1 * half;
    const auto lowest = [&] { return bounds(stepper.state().x).min().z(); };
    while (lowest() > middle - 0.3 * half && stepper.time() < 0.1) stepper.advance(1);
    REQUIRE(lowest() < middle);
    for (int i = 0; i < 3; ++i) {
      REQUIRE(stepper.change_step(i % 2 == 0 ? step / 2 : step));
      for (const Contact& contact : stepper.contacts()) CHECK(contact.normal.z() > 0.99);
      stepper.advance(1);
    }
  }
}

TEST_CASE("Rounding in single precision is not taken for divergence, which is reported") {
  MassSpringModel model = two_material_block(6);
  for (double& damping : model.damping) damping = 0;
  Scenario scene;
  scene.gravity = Vec3::Zero();
  RunOptions options{.precision = Precision::single_precision};
  const Trajectory rest = run(model, scene, options);
  const double size = bounds(model.rest).diagonal().norm();
  for (std::size_t i = 0; i < model.node_count(); ++i)
    CHECK((rest.final.x[i] - model.rest[i]).norm() < 1e-5 * size);
  options.step = 1.2 * rest.predicted_step;
  CHECK_THROWS_AS(run(model, scene, options), UnstableError);
}

TEST_CASE("A fast step reports the node that went through a wall as the plain one does") {
  const MassSpringModel model = two_material_block(4);
  Scenario scene;
  Obstacle wall;
  wall.name = "wall";
  wall.stiffness = 1e3;
  wall.shape =
      SolidBox{.center = bounds(model.rest).center() + Vec3(0.1, 0, 0), .half_size = {0.002, 1, 1}};
  scene.obstacles = {wall};
  scene.start.velocity = {20, 0, 0};
  const auto message = [&](auto&& scheme) -> std::string {
    try {
      scheme();
    } catch (const TunnelError& e) {
      return e.what();
    }
    return {};
  };
  const std::string plain = message([&] { after<Leapfrog>(model, scene, 1000, {}, 1); });
  CHECK(plain.find("went through") != std::string::npos);
  CHECK(message([&] { after<FastLeapfrog>(model, scene, 1000, {}, 1); }) == plain);
  CHECK(message([&] { after<FastLeapfrog>(model, scene, 1000, {}, 1000); }) == plain);
}

TEST_CASE("Rows hold every spring once and are nearly full on a lattice") {
  const MassSpringModel model = two_material_block(23);
  const auto layout = make_row_layout<double>(model);
  CHECK(static_cast<double>(model.spring_count()) > 6.5 * static_cast<double>(layout.rows.size()));
  CHECK(layout.properties.size() < layout.rows.size() / 4);
  for (const RowBlock& block : layout.blocks) {
    CHECK(block.first % kRowLanes == 0);
    CHECK(block.reach % kRowLanes == 0);
  }
  double stiffness = 0;
  double expected = 0;
  for (const SpringRow& row : layout.rows)
    for (const double k : layout.properties[row.properties].stiffness) stiffness += k;
  for (const double k : model.stiffness) expected += k;
  CHECK(stiffness == Approx(expected));
}
