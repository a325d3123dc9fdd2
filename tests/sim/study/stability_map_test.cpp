#include "sim/study/stability_map.hpp"

#include <cmath>

#include <catch2/catch.hpp>

#include "base/error.hpp"
#include "elastic/stable_step.hpp"
#include "lod/merging/merge.hpp"
#include "sim/run.hpp"
#include "sim/run/motion.hpp"
#include "sim/study/probe.hpp"
#include "sim/study/stiffness_ratio.hpp"
#include "tests/sim/scenes.hpp"

using namespace springlod;
using namespace springlod::sim;

namespace {

LodChain chain_of(const MassSpringModel& base, std::uint32_t levels = 0) {
  if (levels > 0) return lod::simplify(base, {.levels = levels});
  return {.levels = {Level{base, identity_groups(base.node_count()), "base"}}};
}

/// A bar of 2 x 2 x 6 cells. The lower half is "rod"; the upper half is "rubber", a thousand times
/// softer.
MassSpringModel two_halves(voxelize::LatticeStyle style) {
  std::vector<std::pair<voxelize::CellIndex, std::uint16_t>> cells;
  for (int z = 0; z < 6; ++z)
    for (int y = 0; y < 2; ++y)
      for (int x = 0; x < 2; ++x)
        cells.push_back({{x, y, z}, static_cast<std::uint16_t>(z < 3 ? 0 : 1)});
  const auto grid = test::grid_of(
      cells, 0.1,
      {test::material("rod", 1e8, 1000, 0.0005), test::material("rubber", 1e5, 1000, 0.0005)});
  return voxelize::build_lattice(grid, {.style = style}).model;
}

MassSpringModel one_material() {
  return test::block(2, 2, 4, 0.1, test::material("m", 1e5, 1000, 0.0005),
                     voxelize::LatticeStyle::corners);
}

double largest_difference(const std::vector<double>& a, const std::vector<double>& b) {
  REQUIRE(a.size() == b.size());
  double largest = 0;
  for (std::size_t i = 0; i < a.size(); ++i) largest = std::max(largest, std::abs(a[i] / b[i] - 1));
  return largest;
}

}  // namespace

TEST_CASE("At the ratio it has a body of two materials keeps its springs") {
  const auto style = GENERATE(voxelize::LatticeStyle::centers, voxelize::LatticeStyle::corners);
  const LodChain chain = chain_of(two_halves(style), 1);
  const LodChain same = with_stiffness_ratio(chain, stiff_part(chain.levels[0].model), 1000);
  for (std::size_t level = 0; level < 2; ++level) {
    CHECK(largest_difference(same.levels[level].model.stiffness,
                             chain.levels[level].model.stiffness) < 1e-12);
    CHECK(largest_difference(same.levels[level].model.damping, chain.levels[level].model.damping) <
          1e-12);
  }
}

TEST_CASE("A ratio scales the stiff part, leaves the soft one and meets in the harmonic mean") {
  const MassSpringModel base = two_halves(voxelize::LatticeStyle::centers);
  const StiffPart part = stiff_part(base);
  CHECK(part.name == "rod");
  const LodChain chain = with_stiffness_ratio(chain_of(base), part, 10);
  const MassSpringModel& model = chain.levels[0].model;
  const double soft = 1e5 * 0.1 / 2.5;  // k = E a / 2.5
  for (std::uint32_t s = 0; s < model.spring_count(); ++s) {
    const int stiff_ends = part.of_node[model.a[s]] + part.of_node[model.b[s]];
    const double wanted = stiff_ends == 0 ? soft : stiff_ends == 2 ? 10 * soft : 20. / 11 * soft;
    CHECK(model.stiffness[s] == Approx(wanted));
    CHECK(model.damping[s] / model.stiffness[s] == Approx(0.0005));
  }
  CHECK(model.materials[0].young == Approx(1e6));
  CHECK(model.materials[1].young == 1e5);
  CHECK_THROWS_AS(with_stiffness_ratio(chain_of(base), part, 0), InputError);
}

TEST_CASE("A body of one material becomes stiff beyond its centre of mass") {
  const MassSpringModel base = one_material();
  const StiffPart part = stiff_part(base);
  CHECK_THAT(part.name, Catch::Contains("along z"));
  for (std::uint32_t i = 0; i < base.node_count(); ++i)
    CHECK((part.of_node[i] == 1) == (base.rest[i].z() > 0.2 + 1e-9));
}

TEST_CASE("A level of a rescaled chain is the rescaled base merged by the same groups") {
  const MassSpringModel base = test::rods();
  const LodChain chain = chain_of(base, 2);
  const LodChain rescaled = with_stiffness_ratio(chain, stiff_part(base), 1e4);
  for (const std::size_t level : {1U, 2U}) {
    const MassSpringModel merged =
        lod::merge(rescaled.levels[0].model, rescaled.levels[level].of_base);
    CHECK(largest_difference(rescaled.levels[level].model.stiffness, merged.stiffness) < 1e-9);
  }
}

TEST_CASE("The probed motion has no momentum and turns as slowly as it is meant to") {
  const MassSpringModel model = test::rods();
  const ProbeMotion motion = probe_motion(model, 10, 0.5);
  CHECK(motion.along == Vec3::UnitZ());
  const State state = probe_state(model, motion);
  Vec3 momentum = Vec3::Zero();
  for (std::uint32_t i = 0; i < model.node_count(); ++i) momentum += model.mass[i] * state.v[i];
  CHECK(momentum.norm() < 1e-9 * mass_properties(model).mass * motion.speed);
  CHECK((angular_velocity(model, state) - motion.spin).norm() < 1e-9 * motion.spin.norm());
}

TEST_CASE("From ratio 1 to 1e5 explicit schemes hold below their limit and are caught above it") {
  const LodChain chain = chain_of(one_material());
  StabilityOptions options;
  options.integrators = {Integrator::symplectic_euler, Integrator::velocity_verlet,
                         Integrator::runge_kutta_4};
  options.steps = {0.9, 1.15};
  const StabilityMap map = stability_map(chain, options);
  REQUIRE(map.points.size() == 6 * 3 * 2);
  double limit = map.bodies.front().limit;
  for (const StabilityBody& body : map.bodies) {
    CAPTURE(body.ratio);
    CHECK(body.reference_error < 5e-3);
    CHECK(body.limited_by == StepBound::springs);
    // For large ratios, the limit falls with the square root of the ratio.
    if (body.ratio > 100) CHECK(limit / body.limit == Approx(std::sqrt(10)).epsilon(0.05));
    limit = body.limit;
  }
  for (const StabilityPoint& point : map.points) {
    CAPTURE(to_string(point.integrator), map.bodies[point.body].ratio, point.step / point.limit);
    if (point.step < point.limit) {
      CHECK(point.stable);
      // Runge-Kutta damps fast vibrations; here all modes are fast, so it damps too much.
      const bool damps = point.integrator == Integrator::runge_kutta_4 && point.energy_drift < 0;
      CHECK((point.verdict == Verdict::stable || (damps && point.verdict == Verdict::drifting)));
      if (point.integrator == Integrator::runge_kutta_4) CHECK(point.energy_drift < -0.01);
      CHECK(point.error < 0.08);
      CHECK_FALSE(point.diverged_at.has_value());
    } else {
      CHECK_FALSE(point.stable);
      CHECK(point.verdict == Verdict::diverged);
      REQUIRE(point.node.has_value());
      CHECK(*point.node < chain.levels[0].model.node_count());
      CHECK(*point.diverged_at > 0);
      CHECK(*point.diverged_at < 200 * point.step);
    }
  }
}

TEST_CASE(
    "From ratio 1 to 1e5 backward Euler stays within its energy, cut short schemes are named") {
  const LodChain chain = chain_of(one_material());
  StabilityOptions options;
  options.integrators = {Integrator::backward_euler_cg, Integrator::backward_euler_direct,
                         Integrator::xpbd, Integrator::projective_dynamics};
  options.implicit_steps = {0.01, 0.05};
  options.sweep_steps = {0.01, 0.05};
  const StabilityMap map = stability_map(chain, options);
  for (const StabilityPoint& point : map.points) {
    const double ratio = map.bodies[point.body].ratio;
    CAPTURE(to_string(point.integrator), ratio, point.step);
    const bool newton = point.integrator == Integrator::backward_euler_cg ||
                        point.integrator == Integrator::backward_euler_direct;
    if (newton) {
      CHECK(point.stable);
      CHECK(point.energy_drift < 0);
      CHECK(point.error < 0.5);
      CHECK(point.unconverged_steps == 0);
    } else if (ratio >= 1000 && point.step > 0.04 * map.bodies[point.body].period) {
      // A few sweeps cannot transmit forces through stiff springs: no point has the verdict
      // "stable".
      CHECK(
          (!point.finished || point.energy_drift < kRunaway || point.verdict == Verdict::runaway));
      CHECK(point.verdict != Verdict::stable);
      CHECK((!point.finished || point.error > kInaccurate));
    }
  }
}

TEST_CASE("The limit of a held body is that of its free nodes") {
  const MassSpringModel base = two_halves(voxelize::LatticeStyle::corners);
  StabilityOptions options;
  options.ratios = {1000};
  options.integrators = {Integrator::symplectic_euler, Integrator::runge_kutta_4};
  options.steps = {0.9, 1.15};
  const auto limit_with = [&](StabilityOptions some) {
    some.integrators = {Integrator::symplectic_euler};
    some.steps = {0.9};
    some.periods = 0.1;
    return stability_map(chain_of(base), some).bodies.front().limit;
  };
  const double free_limit = limit_with(options);
  Anchor vice{.name = "vice", .nodes = {}};
  for (std::uint32_t i = 0; i < base.node_count(); ++i)
    if (base.rest[i].z() < 0.3 + 1e-9) vice.nodes.push_back(i);  // all of the rod
  options.anchors = {vice};
  const StabilityMap map = stability_map(chain_of(base), options);
  CHECK(map.bodies.front().limit > 5 * free_limit);
  REQUIRE(map.points.size() == 4);
  for (const StabilityPoint& point : map.points) {
    CAPTURE(to_string(point.integrator), point.step / point.limit);
    CHECK((point.verdict == Verdict::diverged) == (point.step > point.limit));
  }
  // Springs hold no node.
  options.anchors.front().spring = AnchorSpring{.stiffness = 10};
  CHECK(limit_with(options) == free_limit);
}

TEST_CASE("A chain with dilatation terms is mapped by the integrators that know them") {
  Material rubber = test::material("rubber", 1e5, 1000, 0.0005);
  rubber.poisson = 0.45;
  const LodChain chain =
      chain_of(test::block(2, 2, 4, 0.1, rubber, voxelize::LatticeStyle::corners));
  StabilityOptions options{.ratios = {1}, .steps = {0.5, 2}, .periods = 0.5};
  const StabilityMap map = stability_map(chain, options);
  REQUIRE(map.points.size() == 6);
  for (const StabilityPoint& point : map.points) {
    CHECK_FALSE(is_implicit(point.integrator));
    CHECK(point.stable == (point.step < point.limit));
  }
  options.integrators = {Integrator::xpbd};
  CHECK_THROWS_AS(stability_map(chain, options), InputError);
}

TEST_CASE("An over-merged level with a mechanism is named and not run") {
  const MassSpringModel base = test::rods();
  LodChain chain;
  // Raw merges, without guards, of the rods have mechanisms at level 3 for some seeds.
  for (std::uint64_t seed = 1; seed < 30; ++seed) {
    chain = lod::simplify(base, {.levels = 3, .grouping = {.seed = seed}, .guards = false});
    StabilityOptions options;
    options.levels = {3};
    options.ratios = {50};
    options.integrators = {Integrator::symplectic_euler};
    options.steps = {0.9};
    const StabilityMap map = stability_map(chain, options);
    if (map.bodies[0].loose_nodes == 0) continue;
    CHECK(map.points[0].verdict == Verdict::mechanism);
    CHECK_FALSE(map.points[0].stable);
    CHECK_FALSE(map.points[0].finished);
    REQUIRE(map.points[0].node.has_value());
    CHECK(*map.points[0].node == map.bodies[0].loosest_node);
    return;
  }
  FAIL("no seed gave a mechanism");
}

TEST_CASE("A bar one cell thick is a mechanism on centers and sound on corners") {
  const auto bar = [](voxelize::LatticeStyle style) {
    return test::block(1, 1, 6, 0.1, test::material("m", 1e5, 1000, 0), style);
  };
  StabilityOptions options;
  options.ratios = {1};
  options.integrators = {Integrator::symplectic_euler};
  options.steps = {0.9};
  const StabilityMap loose = stability_map(chain_of(bar(voxelize::LatticeStyle::centers)), options);
  CHECK(loose.points[0].verdict == Verdict::mechanism);
  CHECK(loose.bodies[0].loose_nodes > 0);
  const StabilityMap sound = stability_map(chain_of(bar(voxelize::LatticeStyle::corners)), options);
  CHECK(sound.points[0].verdict == Verdict::stable);
  CHECK(sound.bodies[0].loose_nodes == 0);
  // A plate of one layer of centers bends freely.
  const auto plate =
      test::block(5, 4, 1, 0.1, test::material("m", 1e5, 1000, 0), voxelize::LatticeStyle::centers);
  CHECK(stability_map(chain_of(plate), options).points[0].verdict == Verdict::mechanism);
}

TEST_CASE("A level used off the ratio that it was made for is named, with its frequency error") {
  const LodChain chain = chain_of(test::rods(), 1);
  StabilityOptions options;
  options.levels = {1};
  options.ratios = {1, 50, 1000};  // made for 50
  options.integrators = {Integrator::symplectic_euler};
  options.steps = {0.9};
  options.periods = 0.3;
  options.remake_levels = false;
  const StabilityMap map = stability_map(chain, options);
  CHECK(map.points[0].verdict == Verdict::off_design);
  CHECK(map.bodies[0].frequency_error > kOffDesign);
  CHECK(map.points[1].verdict == Verdict::stable);
  CHECK(map.bodies[1].frequency_error < kOffDesign);

  options.remake_levels = true;
  for (const StabilityPoint& point : stability_map(chain, options).points)
    CHECK(point.verdict == Verdict::stable);
}

TEST_CASE("A map shows damping as what bounds the step") {
  LodChain chain = chain_of(test::block(2, 2, 4, 0.1, test::material("m", 1e5, 1000, 0.05),
                                        voxelize::LatticeStyle::corners));
  StabilityOptions options;
  options.ratios = {1};
  options.integrators = {Integrator::symplectic_euler};
  options.steps = {0.9, 1.15};
  options.damping = true;
  const StabilityMap map = stability_map(chain, options);
  CHECK(map.bodies[0].limited_by == StepBound::damping);
  CHECK(map.points[0].verdict == Verdict::stable);
  CHECK(map.points[1].verdict == Verdict::diverged);
}

TEST_CASE("A map has the same bits with one thread and three") {
  const LodChain chain = chain_of(one_material(), 1);
  StabilityOptions options;
  options.ratios = {1, 100};
  options.periods = 0.2;
  const auto with = [&](std::uint32_t threads) {
    options.threads = threads;
    return stability_map(chain, options);
  };
  const StabilityMap one = with(1);
  const StabilityMap three = with(3);
  REQUIRE(one.points.size() == three.points.size());
  for (std::size_t i = 0; i < one.points.size(); ++i) {
    CHECK(one.points[i].error == three.points[i].error);
    CHECK(one.points[i].energy_drift == three.points[i].energy_drift);
    CHECK(one.points[i].cost == three.points[i].cost);
    CHECK(one.points[i].diverged_at == three.points[i].diverged_at);
    CHECK(one.points[i].step == three.points[i].step);
  }
}

TEST_CASE("A map can be interrupted and refuses what it cannot map") {
  struct Stop : Progress {
    void advance(std::uint64_t) override { throw InterruptedError(); }
  } stop;
  const LodChain chain = chain_of(one_material());
  CHECK_THROWS_AS(stability_map(chain, {.progress = &stop}), InterruptedError);
  CHECK_THROWS_WITH(stability_map(chain, {.levels = {3}}), Catch::Contains("levels: 3"));
  CHECK_THROWS_WITH(stability_map(chain, {.ratios = {-1}}), Catch::Contains("ratios"));
  CHECK_THROWS_WITH(stability_map(chain, {.steps = {0}}), Catch::Contains("steps"));
  CHECK_THROWS_AS(stability_map({}, {}), InputError);
}
