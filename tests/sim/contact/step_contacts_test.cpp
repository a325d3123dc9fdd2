#include "sim/contact/step_contacts.hpp"

#include <cmath>
#include <random>

#include <Eigen/Geometry>
#include <catch2/catch.hpp>

#include "sim/correction/plain_correction.hpp"
#include "sim/integrators/leapfrog.hpp"
#include "sim/integrators/step_limit.hpp"
#include "sim/run.hpp"
#include "tests/sim/scenes.hpp"

using namespace springlod;
using namespace springlod::sim;

namespace {

std::shared_ptr<ContactSkin> skin_of(const LodChain& chain, std::uint32_t level) {
  return std::make_shared<ContactSkin>(contact_skin(chain, level));
}

MassSpringModel without_corners(MassSpringModel model) {
  model.corners.clear();
  return model;
}

/// One node of 2 kg and 1 m2.
MassSpringModel one_node(const Vec3& at) {
  MassSpringModel node;
  node.rest = {at};
  node.mass = {2};
  node.volume = {1};
  node.contact_area = {1};
  node.border = {1};
  node.material = {0};
  node.materials = {Material{.name = "m"}};
  return node;
}

/// A body without springs and corners that moves over one step, with its contacts. The obstacles
/// must outlive it.
struct OneStep {
  OneStep(const MassSpringModel& of_model, const std::vector<Obstacle>& obstacles,
          const ContactSkin* skin)
      : model(without_corners(of_model)),
        points(skin != nullptr ? ContactPoints(model, *skin) : ContactPoints(model)),
        finder(points, obstacles, model.rest),
        correction(model, points, finder, obstacles.size(), true, {}),
        x(model.rest) {}

  /// Kinetic energy of the nodes [J].
  double kinetic(const std::vector<Vec3>& v) const {
    double sum = 0;
    for (std::size_t i = 0; i < v.size(); ++i) sum += 0.5 * model.mass[i] * v[i].squaredNorm();
    return sum;
  }
  /// Moves the body with the velocities v for `step` [s]; returns what all entries gained [J].
  double advance(double step, std::vector<Vec3>& v) {
    const double before = kinetic(v) + contact_energy(contacts.now());
    std::vector<Vec3> x_next = x;
    for (std::size_t i = 0; i < x.size(); ++i) x_next[i] += step * v[i];
    correction.correct(step, x, x_next, v);
    x = x_next;
    return kinetic(v) + contact_energy(contacts.now()) + contacts.losses().contact +
           contacts.losses().friction - before;
  }

  MassSpringModel model;
  ContactPoints points;
  ContactFinder finder;
  PlainCorrection correction;
  StepCorrection& contacts = correction.solver();
  std::vector<Vec3> x;
};

}  // namespace

TEST_CASE("Energy, stored and lost, adds up in every step of many touching points") {
  const LodChain& chain = test::small_chain();
  const bool at_surface = GENERATE(false, true);
  const double friction = GENERATE(0.0, 0.7);
  const double damping = GENERATE(0.0, 1e-3);
  const MassSpringModel& model = chain.levels[1].model;
  std::vector<Obstacle> corner{test::floor(1e8, friction), test::floor(1e6, friction)};
  corner[0].shape = Plane{Vec3::UnitZ(), bounds(model.rest).min().z() - 1e-3};
  corner[1].shape = Plane{Vec3::UnitX(), bounds(model.rest).min().x() - 1e-3};
  for (Obstacle& obstacle : corner) obstacle.damping = damping;
  OneStep body(model, corner, at_surface ? skin_of(chain, 1).get() : nullptr);
  std::mt19937 random(1);
  std::uniform_real_distribution<double> speed(-1, 1);
  std::vector<Vec3> v;
  for (std::uint32_t i = 0; i < model.node_count(); ++i)
    v.emplace_back(speed(random) - 1, speed(random), speed(random) - 2);
  CAPTURE(at_surface, friction, damping);
  const double first = body.kinetic(v);
  double lost = 0;
  std::size_t touching = 0;
  for (int i = 0; i < 300; ++i) {
    CHECK(std::abs(body.advance(1e-3, v)) < 1e-9 * first);
    lost += body.contacts.losses().contact + body.contacts.losses().friction;
    touching += body.contacts.now().size();
  }
  CHECK(touching > 100);
  if (friction > 0 || damping > 0 || at_surface)  // the surface compliance has damping
    CHECK(lost > 0.01 * first);
  else
    CHECK(std::abs(lost) < 2e-3 * first);  // the error of the sweeps
}

TEST_CASE("A point held by two obstacles touches both, without a bounce of its own") {
  const MassSpringModel node = one_node({1e-3, 0, 1e-3});
  std::vector<Obstacle> corner{test::floor(1e6, 0), test::floor(1e6, 0)};
  corner[1].shape = Plane{Vec3::UnitX(), 0};
  OneStep body(node, corner, nullptr);
  std::vector<Vec3> v{Vec3(-3, 1, -3)};
  body.advance(1e-3, v);
  REQUIRE(body.contacts.now().size() == 2);
  CHECK(body.x[0].x() == Approx(body.x[0].z()));
  CHECK(v[0].x() == Approx(v[0].z()));
  CHECK(v[0].y() == 1);
}

TEST_CASE("A point that slides off an edge is let go, and what its contact stored is lost") {
  std::vector<Obstacle> table{test::floor(1e6, 0)};
  table[0].shape = SolidBox{.half_size = {1, 1, 1}};
  OneStep body(one_node({0.98, 0, 1 + 1e-4}), table, nullptr);
  std::vector<Vec3> v{Vec3(12, 0, -1)};
  CHECK(std::abs(body.advance(1e-3, v)) < 1e-12);
  REQUIRE(body.contacts.now().size() == 1);
  const double stored = contact_energy(body.contacts.now());
  const Vec3 before = v[0];
  CHECK(std::abs(body.advance(1e-3, v)) < 1e-12);
  CHECK(body.x[0].x() > 1);
  CHECK(body.x[0].z() < 1);
  CHECK(body.contacts.now().empty());
  CHECK(body.contacts.losses().contact == Approx(stored));
  CHECK(v[0] == before);
}

TEST_CASE("A point that comes in at the top of a box near an edge is pressed up") {
  std::vector<Obstacle> table{test::floor(1e6, 0)};
  table[0].shape = SolidBox{.half_size = {1, 1, 1}};
  OneStep body(one_node({1 - 5e-4, 0, 1 + 1e-3}), table, nullptr);
  std::vector<Vec3> v{Vec3(0, 0, -3)};
  body.advance(1e-3, v);
  REQUIRE(body.contacts.now().size() == 1);
  CHECK(body.contacts.now()[0].normal == Vec3::UnitZ());
  CHECK(v[0].z() > -3);
  CHECK(v[0].x() == 0);
}

TEST_CASE("A box without damping and friction gives a point no energy, at any edge and speed") {
  const double speed = GENERATE(0.1, 3.0, 100.0);  // up to a tenth of the box in a step
  std::vector<Obstacle> block{test::floor(1e6, 0)};
  block[0].shape = SolidBox{.half_size = {1, 0.7, 0.02}};
  std::mt19937 random(7);
  std::uniform_real_distribution<double> uniform(-1, 1);
  const auto any = [&] { return Vec3(uniform(random), uniform(random), uniform(random)); };
  std::size_t touching = 0;
  for (int i = 0; i < 500; ++i) {
    const Vec3 way = speed * any();
    const Vec3 edge(1, 0.7 * uniform(random), 0.02);
    OneStep body(one_node(edge - 3e-3 * way), block, nullptr);
    if (surface_distance(block[0], body.x[0]).distance < 0) continue;
    std::vector<Vec3> v{way + 0.1 * speed * any()};
    double energy = body.kinetic(v);
    for (int step = 0; step < 12; ++step) {
      CHECK(std::abs(body.advance(1e-3, v)) < 1e-9 * energy);
      const double now = body.kinetic(v) + contact_energy(body.contacts.now());
      CHECK(now < (1 + 1e-9) * energy);
      energy = now;
      touching += body.contacts.now().size();
    }
  }
  CHECK(touching > 50);
}

TEST_CASE("A body at rest on an automatic floor sinks in by less than 1 % of a cell") {
  const double young = GENERATE(5e4, 1e6, 1e8);
  const double cell = 0.0125;
  const auto model = test::block(8, 8, 8, cell, test::material("m", young, 1000, 0.05),
                                 voxelize::LatticeStyle::corners);
  Scenario scene;
  scene.obstacles = {test::floor(1, 0.5)};
  scene.obstacles[0].stiffness.reset();
  scene.start.placed = true;
  scene.start.position = {0, 0, 4 * cell};
  ContactPoints points(model);
  // Its weight on the contacts of its lower side, which is one stiffness of all of them.
  double stiffness = 0;
  for (std::uint32_t p = 0; p < points.count(); ++p)
    if (model.rest[points.number(p)].z() < bounds(model.rest).min().z() + 0.1 * cell)
      stiffness += points.stiffness(p, scene.obstacles[0], 0);
  const double weight = 9.81 * mass_properties(model).mass;
  CHECK(weight / stiffness < 0.01 * cell);
  CHECK(weight / stiffness > 1e-6 * cell);
}

TEST_CASE("The rebound at the body's step is that of a fiftieth of it, for any floor") {
  const LodChain chain =
      lod::simplify(test::block(5, 5, 4, 0.1, test::material("m", 1e6, 1000, 1e-4),
                                voxelize::LatticeStyle::corners),
                    {});
  const std::uint32_t level = GENERATE(0U, 1U, 2U);
  const bool at_surface = GENERATE(false, true);
  Scenario scene = test::weightless(0.25);
  scene.obstacles = {test::floor(GENERATE(1e6, 1e9), 0)};
  scene.start.placed = true;
  scene.start.position = {0, 0, 0.3};
  scene.start.rotation = Eigen::AngleAxisd(0.3, Vec3(1, 2, 3).normalized()).toRotationMatrix();
  scene.start.velocity = {0, 0, -1};
  const MassSpringModel& model = chain.levels[level].model;
  const auto rebound = [&](double safety) {
    RunOptions options{.safety = safety, .frame_rate = 0};
    if (at_surface) options.skin = skin_of(chain, level);
    const Trajectory t = run(model, scene, options);
    return center_of_mass(model, t.final.v).z();
  };
  CAPTURE(level, at_surface, *scene.obstacles[0].stiffness);
  const double fine = rebound(0.8 / 50);
  CHECK(fine > 0.1);
  CHECK(rebound(0.8) == Approx(fine).epsilon(0.02));
}
