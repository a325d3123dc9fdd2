#include "sim/run/step_watch.hpp"

#include <algorithm>
#include <cmath>

#include <catch2/catch.hpp>

#include "base/error.hpp"
#include "elastic/stable_step.hpp"
#include "sim/integrators/step_limit.hpp"
#include "sim/run.hpp"
#include "tests/sim/scenes.hpp"

using namespace springlod;
using namespace springlod::sim;

namespace {

MassSpringModel soft_block() {
  return test::block(5, 5, 5, 0.1, test::material("m", 1e5, 1000, 0),
                     voxelize::LatticeStyle::corners);
}

std::vector<Vec3> scaled(const MassSpringModel& model, const Vec3& by) {
  std::vector<Vec3> x = model.rest;
  for (Vec3& p : x) p = p.cwiseProduct(by);
  return x;
}

std::size_t inner_node(const MassSpringModel& model) {
  const Vec3 middle = bounds(model.rest).center();
  return static_cast<std::size_t>(std::min_element(model.rest.begin(), model.rest.end(),
                                                   [&](const Vec3& p, const Vec3& q) {
                                                     return (p - middle).norm() <
                                                            (q - middle).norm();
                                                   }) -
                                  model.rest.begin());
}

}  // namespace

TEST_CASE("A node's frequency bound grows as springs are stretched or flattened") {
  MassSpringModel pair;
  pair.rest = {Vec3::Zero(), Vec3::UnitX()};
  pair.mass = {2, 2};
  pair.a = {0};
  pair.b = {1};
  pair.rest_length = {1};
  pair.stiffness = {8};
  const auto bounds_at = [](const MassSpringModel& model, const std::vector<Vec3>& x) {
    return elastic::node_frequency_bounds(model, x);
  };
  // Stretched or not, the spring is stiffest along its direction: 2 k / m.
  CHECK(bounds_at(pair, pair.rest)[0] == Approx(8));
  CHECK(bounds_at(pair, {Vec3::Zero(), 3 * Vec3::UnitX()})[1] == Approx(8));

  const MassSpringModel model = soft_block();
  const auto rest = bounds_at(model, model.rest);
  // The light corner nodes have the largest bound, which is not exact.
  const double most = std::sqrt(*std::max_element(rest.begin(), rest.end()));
  CHECK(most > (1 - 1e-12) * elastic::frequency_bound(model));
  CHECK(most < 1.1 * elastic::frequency_bound(model));
  // At inner nodes, the sum over all springs is isotropic. At twice the length, each spring counts
  // 1 + 2 (1 - 1/2) times.
  const std::size_t inside = inner_node(model);
  CHECK(bounds_at(model, scaled(model, {2, 2, 2}))[inside] == Approx(2 * rest[inside]));
  // In a flattened body, the diagonal springs lie in the plane.
  CHECK(bounds_at(model, scaled(model, {1, 1, 0.05}))[inside] > 1.2 * rest[inside]);
  const Mat3 turn = Eigen::AngleAxisd(0.7, Vec3(1, 2, 3).normalized()).toRotationMatrix();
  std::vector<Vec3> turned = model.rest;
  for (Vec3& p : turned) p = turn * p;
  CHECK(bounds_at(model, turned)[0] == Approx(rest[0]));
}

TEST_CASE("The step is halved where springs are strained hard, and doubled again") {
  const MassSpringModel model = soft_block();
  Scenario scene = test::weightless(1);
  const StepLimit limit = step_limit(model);
  const double step = 0.8 * limit.step;
  StepController watch(model, limit, step);
  const auto at = [&](const std::vector<Vec3>& x, double strain, double change,
                      std::uint64_t number) {
    return watch.step_for(x, {.strain = strain, .corner_change = change, .step_number = number});
  };
  const std::vector<Vec3> stretched = scaled(model, {2, 2, 2});
  CHECK(at(model.rest, 0, 0, 64) == step);
  CHECK(at(stretched, 1, 0, 128) == step / 2);
  CHECK(at(scaled(model, {1.3, 1.3, 1.3}), 0.3, 0, 144) == step / 2);  // not back and forth
  // It is doubled late, and the second time later, so that it cannot follow a vibration.
  CHECK(at(model.rest, 0, 0, 144 + 511) == step / 2);
  CHECK(at(model.rest, 0, 0, 144 + 512) == step);
  CHECK(at(stretched, 1, 0, 1000) == step / 2);
  CHECK(at(model.rest, 0, 0, 1000 + 1023) == step / 2);
  CHECK(at(model.rest, 0, 0, 1000 + 1024) == step);
  // Corners that change fast halve it once, for they are stable with any step.
  CHECK(watch.corners_may_halve());
  CHECK(at(model.rest, 0, 0.2, 3000) == step / 2);
  CHECK_FALSE(watch.corners_may_halve());
  CHECK(at(model.rest, 0, 0.2, 3016) == step / 2);
}

TEST_CASE("A body let go stretched to twice its size only holds with the step adapted") {
  const MassSpringModel model = soft_block();
  Scenario scene = test::weightless(2);
  const State start{scaled(model, {2, 2, 2}), std::vector<Vec3>(model.node_count(), Vec3::Zero()),
                    0};
  // The body inverts as it springs back; only the step is checked here.
  RunOptions options{.safety = 0.95};
  const Trajectory adapted = run(model, scene, start, options);
  CHECK(adapted.shortest_step < adapted.step);
  CHECK(adapted.simulated == Approx(2));
  options.step = adapted.step;
  CHECK_THROWS_AS(run(model, scene, start, options), UnstableError);
}

TEST_CASE("A body at rest sleeps at no cost, one that falls, floats or has sleep = 0 does not") {
  const MassSpringModel model = test::block(3, 3, 3, 0.1, test::material("m", 1e6, 1000, 0.01),
                                            voxelize::LatticeStyle::corners);
  Scenario scene;
  scene.obstacles = {test::floor(1e6, 0.5)};
  scene.obstacles[0].damping = 0.01;
  std::get<Plane>(scene.obstacles[0].shape).offset = bounds(model.rest).min().z();
  scene.duration = 4;
  const Trajectory slept = run(model, scene);
  REQUIRE(slept.asleep_since.has_value());
  CHECK(slept.simulated == Approx(4));
  CHECK(slept.final.t == Approx(4));
  CHECK(slept.frames.size() == 241);
  CHECK(slept.ledger.size() == 241);
  CHECK(slept.ledger.back().time == Approx(4));
  CHECK(closure_error(slept.ledger) < 0.01);
  scene.duration = 40;
  CHECK(run(model, scene).steps == slept.steps);  // nothing more

  scene.duration = 4;
  const Trajectory awake = run(model, scene, RunOptions{.sleep = 0});
  CHECK_FALSE(awake.asleep_since.has_value());
  CHECK(awake.steps > slept.steps);
  double moved = 0;
  for (std::size_t i = 0; i < awake.final.x.size(); ++i)
    moved = std::max(moved, (awake.final.x[i] - slept.final.x[i]).norm());
  CHECK(moved < 1e-5);

  scene.obstacles.clear();
  CHECK_FALSE(run(model, scene).asleep_since.has_value());
  CHECK_FALSE(run(model, test::weightless(1)).asleep_since.has_value());
  CHECK_THROWS_AS(run(model, scene, RunOptions{.sleep = -1}), InputError);
}
