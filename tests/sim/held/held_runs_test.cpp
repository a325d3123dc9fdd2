// Bodies that are held while they move, under every integrator.
#include <cmath>
#include <numbers>
#include <numeric>

#include <catch2/catch.hpp>

#include "base/error.hpp"
#include "elastic/loads.hpp"
#include "elastic/modes.hpp"
#include "lod/build.hpp"
#include "sim/fast/fast_leapfrog.hpp"
#include "sim/held/held_nodes.hpp"
#include "sim/integrators/leapfrog.hpp"
#include "sim/run.hpp"
#include "tests/sim/side_by_side.hpp"
#include "tests/support/models.hpp"
#include "tests/support/soft_blocks.hpp"

using namespace springlod;
using namespace springlod::sim;
using namespace springlod::test;

namespace {

/// Nodes of the face with the lowest coordinate along x, or the highest.
std::vector<std::uint32_t> face(const MassSpringModel& model, bool high = false) {
  const Box3 box = bounds(model.rest);
  const double at = high ? box.max().x() : box.min().x();
  std::vector<std::uint32_t> nodes;
  for (std::uint32_t i = 0; i < model.node_count(); ++i)
    if (std::abs(model.rest[i].x() - at) < 1e-9) nodes.push_back(i);
  return nodes;
}

double weight(const MassSpringModel& model, const Scenario& scene) {
  return std::accumulate(model.mass.begin(), model.mass.end(), 0.0) * scene.gravity.norm();
}

/// One end stays, the other is drawn out, turned and shaken.
std::vector<Anchor> stay_and_twist(const MassSpringModel& model) {
  const double size = bounds(model.rest).sizes().x();
  return {{.name = "still", .nodes = face(model)},
          {.name = "moved",
           .nodes = face(model, true),
           .path = {{.time = 0.02, .move = {0.1 * size, 0, 0}, .turn = {0.5, 0, 0}},
                    {.time = 0.04, .move = {0.05 * size, 0.05 * size, 0}, .turn = {0.2, 0.1, 0}}}}};
}

Vec3 momentum(const MassSpringModel& model, const State& state) {
  Vec3 sum = Vec3::Zero();
  for (std::uint32_t i = 0; i < model.node_count(); ++i) sum += model.mass[i] * state.v[i];
  return sum;
}

}  // namespace

TEST_CASE("Under every integrator, held nodes are where their anchors are, and the ledger closes") {
  const MassSpringModel model = soft_block(5, 3, 3, 0.25);
  Scenario scene;
  scene.duration = 0.04;
  const std::vector<Anchor> anchors = stay_and_twist(model);
  HeldNodes held(model, anchors, model.rest);
  for (const Integrator integrator : all_choices<Integrator>()) {
    CAPTURE(to_string(integrator));
    RunOptions options{.integrator = integrator,
                       .solver = {.iterations = is_implicit(integrator) ? 100U : 0U},
                       .frame_rate = 50,
                       .anchors = anchors};
    if (is_implicit(integrator)) options.step = 1e-4;
    const Trajectory t = run(model, scene, options);
    held.move_to(t.final.t);
    for (std::uint32_t h = 0; h < held.count(); ++h)
      CHECK((t.final.x[held.node(h)] - held.at()[h]).norm() < 1e-13);
    const double given = t.ledger.back().anchor_work;
    CHECK(given > 0);
    const double drift = t.ledger.back().total() - t.ledger.front().total();
    if (is_implicit(integrator)) {  // they damp by themselves, in proportion to the step
      options.step = 0.5e-4;
      const Trajectory finer = run(model, scene, options);
      CHECK(drift < 0);
      CHECK(drift / (finer.ledger.back().total() - finer.ledger.front().total()) ==
            Approx(2).epsilon(0.15));
    } else {  // leapfrog's trapezoid rule is exact for small rotations only
      CHECK(std::abs(drift) < (integrator == Integrator::runge_kutta_4 ? 1e-10 : 1e-3) * given);
    }
    REQUIRE(t.anchor_loads.size() == t.frames.size());
    double work = 0;
    for (const AnchorLoad& load : t.anchor_loads.back()) work += load.work;
    CHECK(work == Approx(given).epsilon(0.02));
    CHECK(std::abs(t.anchor_loads.back()[0].work) < 1e-9 * given);  // nothing moves there
  }
}

TEST_CASE("The explicit integrators move a held body alike") {
  const MassSpringModel model = soft_block(5, 3, 3, 0.45);
  Scenario scene;
  scene.duration = 0.05;
  RunOptions options{
      .integrator = Integrator::runge_kutta_4, .safety = 0.05, .anchors = stay_and_twist(model)};
  const Trajectory exact = run(model, scene, options);
  for (const Integrator integrator : {Integrator::symplectic_euler, Integrator::velocity_verlet}) {
    options.integrator = integrator;
    options.safety = 0.02;
    const Trajectory t = run(model, scene, options);
    CHECK(largest_difference(t.final.x, exact.final.x) < 1e-4 * bounds(model.rest).sizes().x());
    const AnchorLoad& load = t.anchor_loads.back()[1];
    const AnchorLoad& wanted = exact.anchor_loads.back()[1];
    CHECK((load.force - wanted.force).norm() < 0.01 * wanted.force.norm());
    CHECK((load.torque - wanted.torque).norm() < 0.01 * wanted.torque.norm());
    CHECK(load.work == Approx(wanted.work).epsilon(1e-3));
  }
}

TEST_CASE("A spring on a shaken anchor moves as its equation says") {
  // 2 kg on 800 N/m: omega = 20 rad/s. The anchor follows one smooth cubic.
  MassSpringModel model = table_model({{0, 0, 0}, {1, 0, 0}}, {1, 2}, {{0, 1, 800}});
  model.damping[0] = 0;
  const Scenario scene = weightless(0.4);
  const std::vector<Anchor> anchors{
      {.name = "hand", .nodes = {0}, .path = {{.time = 0.4, .move = {0.1, 0, 0}}}}};
  // u'' = omega^2 (a(t) - u) with a = A (3 s^2 - 2 s^3), s = t / T, from rest: u = a - a'' /
  // omega^2
  // + the free motion that makes u = u' = 0 at 0.
  const double omega = 20;
  const double T = 0.4;
  const double A = 0.1;
  const auto second = [&](double s) { return A * (6 - 12 * s) / (T * T); };
  const double third = -12 * A / (T * T * T);
  const double wt = omega * T;
  const double exact = A - second(1) / (omega * omega) +
                       second(0) / (omega * omega) * std::cos(wt) +
                       third / (omega * omega * omega) * std::sin(wt);
  for (const Integrator integrator : all_choices<Integrator>()) {
    CAPTURE(to_string(integrator));
    const Trajectory t = run(
        model, scene,
        {.integrator = integrator, .solver = {.iterations = 50}, .step = 1e-4, .anchors = anchors});
    CHECK(t.final.x[1].x() - 1 == Approx(exact).margin(is_implicit(integrator) ? 2e-4 : 1e-6));
  }
}

TEST_CASE("Anchors take up the weight of a hanging body, and all momentum that it gains") {
  Material material = soft_material(0.25, 0.02);  // damped within the run
  const MassSpringModel model = block(3, 3, 3, 0.1, material, voxelize::LatticeStyle::corners);
  Scenario scene;
  scene.gravity = {9.81, 0, 0};
  scene.duration = 3;
  const RunOptions options{.frame_rate = 10,
                           .anchors = {{.name = "ceiling", .nodes = face(model)}}};
  const Trajectory t = run(model, scene, options);
  const AnchorLoad& load = t.anchor_loads.back()[0];
  const double carried = weight(model, scene);
  CHECK((load.force + carried * Vec3::UnitX()).norm() < 1e-3 * carried);
  CHECK(std::abs(load.work) < 1e-9);
  // The position at which it hangs is that of the static solution, for small strains.
  elastic::StaticLoad own{.name = "weight", .force = {}};
  for (const double mass : model.mass) own.force.push_back(mass * scene.gravity);
  const auto solution =
      elastic::solve_static(elastic::elastic_body(model, {.anchored = face(model)}), {own});
  double largest = 0;
  double wrong = 0;
  for (std::uint32_t i = 0; i < model.node_count(); ++i) {
    const Vec3 u = solution[0].displacement[i];
    largest = std::max(largest, u.norm());
    wrong = std::max(wrong, (t.final.x[i] - model.rest[i] - u).norm());
  }
  CHECK(wrong < 0.01 * largest);
  // Impulses: those of the anchor and of gravity are the momentum, at every frame.
  Vec3 impulse = Vec3::Zero();
  double before = 0;
  for (std::size_t f = 0; f < t.frames.size(); ++f) {
    impulse += (t.frames[f].time - before) * t.anchor_loads[f][0].force;
    before = t.frames[f].time;
  }
  const Vec3 sum = impulse + t.simulated * carried * Vec3::UnitX();
  CHECK((sum - momentum(model, t.final)).norm() < 1e-3 * carried * t.simulated);
}

TEST_CASE("A clamped bar vibrates at the frequency of its modes with the same anchors") {
  const MassSpringModel model = soft_block(8, 2, 2, 0.25);
  const std::vector<std::uint32_t> clamped = face(model);
  const auto modes =
      elastic::lowest_modes(elastic::elastic_body(model, {.anchored = clamped}), {.count = 1});
  const elastic::Mode& mode = modes.modes.at(0);
  State start = rest_state(model);
  double most = 0;
  for (const Vec3& u : mode.shape) most = std::max(most, u.norm());
  for (std::uint32_t i = 0; i < model.node_count(); ++i) start.x[i] += 1e-4 / most * mode.shape[i];
  const double period = 2 * std::numbers::pi / mode.angular_frequency;
  const Trajectory t =
      run(model, weightless(period / 2), start, {.anchors = {{.name = "clamp", .nodes = clamped}}});
  double wrong = 0;
  for (std::uint32_t i = 0; i < model.node_count(); ++i)
    wrong = std::max(wrong, (t.final.x[i] - model.rest[i] + 1e-4 / most * mode.shape[i]).norm());
  CHECK(wrong < 0.03 * 1e-4);  // half a period later, on the other side, but for damping
}

TEST_CASE("Fast steps of a held body are those of the plain kernel, with contacts and corners") {
  const MassSpringModel lattice = two_material_block(9);
  const bool merged = GENERATE(false, true);
  const MassSpringModel model =
      merged ? lod::simplify(lattice, {.levels = 1}).levels[1].model : lattice;
  const Scenario scene = rough_scene(model);
  // The body swings about one corner of it and hits the floor and the box.
  std::vector<std::uint32_t> grip;
  const Box3 box = bounds(model.rest);
  for (std::uint32_t i = 0; i < model.node_count(); ++i)
    if ((model.rest[i] - box.min()).norm() < 0.4 * box.sizes().x()) grip.push_back(i);
  REQUIRE(grip.size() > 3);
  const std::vector<Anchor> anchors{
      {.name = "grip",
       .nodes = grip,
       .path = {{.time = 0.02, .move = {0.003, 0, -0.001}, .turn = {0, 0.2, 0}}}}};
  constexpr std::uint64_t kSteps = 300;
  const StepperOptions plainly{.anchors = anchors};
  const Outcome plain = after<Leapfrog>(model, scene, kSteps, plainly, 1);
  REQUIRE(plain.contacts > 0);
  REQUIRE(plain.ledger.lost_friction > 0);
  REQUIRE(plain.ledger.anchor_work != 0);
  const double size = box.sizes().norm();
  const Outcome fast = after<FastLeapfrog>(model, scene, kSteps, {.anchors = anchors}, 1);
  CHECK(largest_difference(plain.state.x, fast.state.x) < 1e-9 * size);
  CHECK(largest_difference(plain.state.v, fast.state.v) < 1e-7);
  const double energy = std::abs(plain.ledger.total());
  for (const auto part :
       {&LedgerEntry::kinetic, &LedgerEntry::elastic, &LedgerEntry::gravity, &LedgerEntry::contact,
        &LedgerEntry::lost_damping, &LedgerEntry::lost_friction, &LedgerEntry::lost_contact,
        &LedgerEntry::lost_corners, &LedgerEntry::anchor_work})
    CHECK(fast.ledger.*part == Approx(plain.ledger.*part).margin(1e-7 * energy));
  check_same_bits(fast, after<FastLeapfrog>(model, scene, kSteps, {.anchors = anchors}, 1000));
  check_same_bits(
      fast, after<FastLeapfrog>(model, scene, kSteps, {.threads = 3, .anchors = anchors}, 1000));
  const Outcome single = after<FastLeapfrog>(
      model, scene, kSteps, {.precision = Precision::single_precision, .anchors = anchors}, 1);
  CHECK(largest_difference(plain.state.x, single.state.x) < 1e-4 * size);
  CHECK(single.ledger.anchor_work == Approx(plain.ledger.anchor_work).margin(2e-3 * energy));
}

TEST_CASE("A held body does not sleep before its anchors have come to rest") {
  const MassSpringModel model = soft_block(2, 2, 2, 0.25);
  Scenario scene;
  scene.duration = 1.5;
  scene.obstacles = {floor(1e6, 0.5)};
  std::get<Plane>(scene.obstacles[0].shape).offset = bounds(model.rest).min().z() - 1e-6;
  Anchor pull{.name = "pull",
              .nodes = face(model),
              .path = {{.time = 1.2}, {.time = 1.4, .move = {0, 0, 0.1}}}};
  const Trajectory t = run(model, scene, {.sleep = 0.5, .anchors = {pull}});
  CHECK_FALSE(t.asleep_since);
  pull.path.clear();
  CHECK(run(model, scene, {.sleep = 0.5, .anchors = {pull}}).asleep_since);
}
