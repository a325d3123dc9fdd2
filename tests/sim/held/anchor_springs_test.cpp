// Bodies that anchors pull by springs, under every integrator.
#include "sim/held/anchor_springs.hpp"

#include <cmath>
#include <numbers>
#include <numeric>

#include <catch2/catch.hpp>

#include "elastic/loads.hpp"
#include "elastic/modes.hpp"
#include "lod/build.hpp"
#include "sim/fast/fast_leapfrog.hpp"
#include "sim/integrators/leapfrog.hpp"
#include "sim/run.hpp"
#include "tests/sim/side_by_side.hpp"
#include "tests/support/models.hpp"
#include "tests/support/soft_blocks.hpp"

using namespace springlod;
using namespace springlod::sim;
using namespace springlod::test;

namespace {

std::vector<std::uint32_t> all_nodes(const MassSpringModel& model) {
  std::vector<std::uint32_t> nodes(model.node_count());
  std::iota(nodes.begin(), nodes.end(), 0U);
  return nodes;
}

std::vector<std::uint32_t> nodes_near(const MassSpringModel& model, double x) {
  std::vector<std::uint32_t> nodes;
  for (std::uint32_t i = 0; i < model.node_count(); ++i)
    if (std::abs(model.rest[i].x() - x) < 1e-9) nodes.push_back(i);
  return nodes;
}

double mass_of(const MassSpringModel& model) {
  return std::accumulate(model.mass.begin(), model.mass.end(), 0.0);
}

/// One face held still, the opposite one pulled out and turned by damped springs.
std::vector<Anchor> hold_and_pull(const MassSpringModel& model, double stiffness) {
  const Box3 box = bounds(model.rest);
  return {{.name = "still", .nodes = nodes_near(model, box.min().x())},
          {.name = "pull",
           .nodes = nodes_near(model, box.max().x()),
           .path = {{.time = 0.02, .move = {0.1 * box.sizes().x(), 0, 0}, .turn = {0.5, 0, 0}}},
           .spring = AnchorSpring{.stiffness = stiffness, .damping = 1e-3}}};
}

}  // namespace

TEST_CASE("A body on a damped spring moves as its equation says, under every integrator") {
  // All nodes share the spring, so the body moves as one: m x'' = - k x - k beta x'.
  const MassSpringModel model = table_model({{0, 0, 0}, {1, 0, 0}}, {1, 2}, {{0, 1, 800}});
  const double beta = 0.01;
  const double omega = 20;
  const double stiffness = mass_of(model) * omega * omega;
  const double decay = beta * omega * omega / 2;
  const double ringing = std::sqrt(omega * omega - decay * decay);
  State start = rest_state(model);
  for (Vec3& v : start.v) v = {0.5, -1, 2};
  const double end = 0.4;
  const double exact = std::exp(-decay * end) / ringing * std::sin(ringing * end);
  for (const Integrator integrator : all_choices<Integrator>()) {
    CAPTURE(to_string(integrator));
    const Trajectory t = run(model, weightless(end), start,
                             {.integrator = integrator,
                              .solver = {.iterations = 50},
                              .step = 1e-4,
                              .anchors = {{.name = "spring",
                                           .nodes = all_nodes(model),
                                           .spring = AnchorSpring{stiffness, beta}}}});
    for (std::uint32_t i = 0; i < model.node_count(); ++i)
      CHECK((t.final.x[i] - model.rest[i] - exact * start.v[i]).norm() <
            (is_implicit(integrator) ? 2e-3 : 1e-6));
    CHECK(t.ledger.back().lost_anchors > 0.5 * t.ledger.front().kinetic);
    CHECK(t.ledger.back().anchor_work == 0);  // its other end is still
    CHECK(t.anchor_loads.back()[0].work == 0);
  }
}

TEST_CASE("The ledger of a body that springs pull closes, and its anchors' work is in it") {
  const MassSpringModel model = soft_block(5, 3, 3, 0.25);
  Scenario scene;
  scene.duration = 0.03;
  const std::vector<Anchor> anchors = hold_and_pull(model, 2e4);
  for (const Integrator integrator : all_choices<Integrator>()) {
    CAPTURE(to_string(integrator));
    RunOptions options{.integrator = integrator,
                       .solver = {.iterations = is_implicit(integrator) ? 100U : 0U},
                       .frame_rate = 50,
                       .anchors = anchors};
    if (is_implicit(integrator)) options.step = 1e-4;
    const Trajectory t = run(model, scene, options);
    const LedgerEntry& last = t.ledger.back();
    CHECK(last.anchor_work > 0);
    CHECK(last.anchors > 0);
    CHECK(last.lost_anchors > 0);
    const double drift = last.total() - t.ledger.front().total();
    if (is_implicit(integrator)) {  // they damp by themselves, in proportion to the step
      options.step = 0.5e-4;
      const Trajectory finer = run(model, scene, options);
      CHECK(drift / (finer.ledger.back().total() - finer.ledger.front().total()) ==
            Approx(2).epsilon(0.15));
    } else {  // leapfrog's trapezoid rule is exact for small rotations only
      CHECK(std::abs(drift) <
            (integrator == Integrator::runge_kutta_4 ? 1e-10 : 1e-3) * last.anchor_work);
    }
    double work = 0;
    for (const AnchorLoad& load : t.anchor_loads.back()) work += load.work;
    CHECK(work == Approx(last.anchor_work).epsilon(0.02));
  }
}

TEST_CASE("Springs of any stiffness leave the step alone, and very stiff ones hold the body") {
  const MassSpringModel model = soft_block(4, 2, 2, 0.25);
  Scenario scene;
  scene.duration = 0.05;
  std::vector<Anchor> anchors = hold_and_pull(model, 1e12);
  const RunOptions options{.anchors = anchors};
  const Trajectory pulled = run(model, scene, options);
  anchors[1].spring.reset();
  const Trajectory held = run(model, scene, {.anchors = anchors});
  CHECK(pulled.step == held.step);
  const double size = bounds(model.rest).sizes().x();
  CHECK(largest_difference(pulled.final.x, held.final.x) < 1e-3 * size);
}

TEST_CASE("A body hangs on springs where statics says, and rings at the frequency of its modes") {
  const Material material = soft_material(0.25, 0.02);  // damped within the run
  const MassSpringModel model = block(3, 3, 3, 0.1, material, voxelize::LatticeStyle::corners);
  Scenario scene;
  scene.gravity = {9.81, 0, 0};
  scene.duration = 3;
  const double weight = mass_of(model) * 9.81;
  const Anchor rope{.name = "rope",
                    .nodes = nodes_near(model, bounds(model.rest).min().x()),
                    .spring = AnchorSpring{weight / 0.01, 0.01}};  // stretches by a centimetre
  const Trajectory t = run(model, scene, {.frame_rate = 10, .anchors = {rope}});
  const AnchorLoad& load = t.anchor_loads.back()[0];
  CHECK((load.force + weight * Vec3::UnitX()).norm() < 1e-3 * weight);
  elastic::StaticLoad own{.name = "weight", .force = {}};
  for (const double mass : model.mass) own.force.push_back(mass * scene.gravity);
  const elastic::ElasticBody body =
      elastic::elastic_body(model, {.anchored = support_of({rope}, model)});
  CHECK(body.zero_mode_count() == 0);
  const auto solution = elastic::solve_static(body, {own});
  double largest = 0;
  double wrong = 0;
  for (std::uint32_t i = 0; i < model.node_count(); ++i) {
    const Vec3 u = solution[0].displacement[i];
    largest = std::max(largest, u.norm());
    wrong = std::max(wrong, (t.final.x[i] - model.rest[i] - u).norm());
  }
  CHECK(largest > 0.01);
  CHECK(wrong < 0.01 * largest);

  const MassSpringModel free = soft_block(3, 3, 3, 0.25);
  const Anchor tied{
      .name = "tied", .nodes = rope.nodes, .spring = AnchorSpring{rope.spring->stiffness, 0}};
  const auto modes = elastic::lowest_modes(
      elastic::elastic_body(free, {.anchored = support_of({tied}, free)}), {.count = 1});
  const elastic::Mode& mode = modes.modes.at(0);
  double most = 0;
  for (const Vec3& u : mode.shape) most = std::max(most, u.norm());
  State start = rest_state(free);
  for (std::uint32_t i = 0; i < free.node_count(); ++i) start.x[i] += 1e-4 / most * mode.shape[i];
  RunOptions options{.anchors = {tied}};
  // The anchors hold where the nodes are at the start: a run from the displaced state has them
  // there, so the body must be thrown instead.
  start.x = free.rest;
  for (std::uint32_t i = 0; i < free.node_count(); ++i)
    start.v[i] = 1e-4 * mode.angular_frequency / most * mode.shape[i];
  const double period = 2 * std::numbers::pi / mode.angular_frequency;
  const Trajectory quarter = run(free, weightless(period / 4), start, options);
  double off = 0;
  for (std::uint32_t i = 0; i < free.node_count(); ++i)
    off = std::max(off, (quarter.final.x[i] - free.rest[i] - 1e-4 / most * mode.shape[i]).norm());
  CHECK(off < 0.03 * 1e-4);
}

TEST_CASE("Fast steps of a body on springs are those of the plain kernel, with contacts") {
  const MassSpringModel lattice = two_material_block(9);
  const bool merged = GENERATE(false, true);
  const MassSpringModel model =
      merged ? lod::simplify(lattice, {.levels = 1}).levels[1].model : lattice;
  const Scenario scene = rough_scene(model);
  const Box3 box = bounds(model.rest);
  std::vector<std::uint32_t> grip, thumb;
  for (std::uint32_t i = 0; i < model.node_count(); ++i) {
    if ((model.rest[i] - box.min()).norm() < 0.4 * box.sizes().x()) grip.push_back(i);
    if ((model.rest[i] - box.max()).norm() < 0.2 * box.sizes().x()) thumb.push_back(i);
  }
  REQUIRE(grip.size() > 3);
  REQUIRE(!thumb.empty());
  const std::vector<Anchor> anchors{
      {.name = "grip",
       .nodes = grip,
       .path = {{.time = 0.02, .move = {0.003, 0, -0.001}, .turn = {0, 0.2, 0}}},
       .spring = AnchorSpring{1e4, 1e-3}},
      {.name = "thumb", .nodes = thumb}};
  constexpr std::uint64_t kSteps = 300;
  const Outcome plain =
      after<Leapfrog>(model, scene, kSteps, StepperOptions{.anchors = anchors}, 1);
  REQUIRE(plain.contacts > 0);
  REQUIRE(plain.ledger.lost_friction > 0);
  REQUIRE(plain.ledger.lost_anchors > 0);
  REQUIRE(plain.ledger.anchors > 0);
  const double size = box.sizes().norm();
  const Outcome fast = after<FastLeapfrog>(model, scene, kSteps, {.anchors = anchors}, 1);
  CHECK(largest_difference(plain.state.x, fast.state.x) < 1e-9 * size);
  CHECK(largest_difference(plain.state.v, fast.state.v) < 1e-7);
  const double energy = std::abs(plain.ledger.total());
  for (const auto part :
       {&LedgerEntry::kinetic, &LedgerEntry::elastic, &LedgerEntry::gravity, &LedgerEntry::contact,
        &LedgerEntry::anchors, &LedgerEntry::lost_damping, &LedgerEntry::lost_friction,
        &LedgerEntry::lost_contact, &LedgerEntry::lost_corners, &LedgerEntry::lost_anchors,
        &LedgerEntry::anchor_work})
    CHECK(fast.ledger.*part == Approx(plain.ledger.*part).margin(1e-7 * energy));
  check_same_bits(fast, after<FastLeapfrog>(model, scene, kSteps, {.anchors = anchors}, 1000));
  check_same_bits(
      fast, after<FastLeapfrog>(model, scene, kSteps, {.threads = 3, .anchors = anchors}, 1000));
  const Outcome single = after<FastLeapfrog>(
      model, scene, kSteps, {.precision = Precision::single_precision, .anchors = anchors}, 1);
  CHECK(largest_difference(plain.state.x, single.state.x) < 1e-4 * size);
  CHECK(single.ledger.anchor_work == Approx(plain.ledger.anchor_work).margin(2e-3 * energy));
}
