#include "sim/contact/contact_skin.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

#include <Eigen/Eigenvalues>
#include <catch2/catch.hpp>

#include "base/error.hpp"
#include "base/script_number.hpp"
#include "elastic/stable_step.hpp"
#include "sim/contact/contact.hpp"
#include "sim/fast/fast_leapfrog.hpp"
#include "sim/integrators/leapfrog.hpp"
#include "sim/integrators/step_limit.hpp"
#include "sim/run.hpp"
#include "sim/study/compare.hpp"
#include "tests/sim/side_by_side.hpp"
#include "tests/support/models.hpp"

using namespace springlod;
using namespace springlod::sim;
using namespace springlod::test;

namespace {

std::shared_ptr<const ContactSkin> skin_of(const LodChain& chain, std::uint32_t level) {
  return std::make_shared<ContactSkin>(contact_skin(chain, level));
}

/// Vectors with coordinates in [-size, size), the same for the same seed.
std::vector<Vec3> random_vectors(std::size_t count, double size, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  const auto unit = [&] { return 2 * static_cast<double>(random() >> 11U) * 0x1p-53 - 1; };
  std::vector<Vec3> vectors(count);
  for (Vec3& v : vectors)
    for (int axis = 0; axis < 3; ++axis) v[axis] = size * unit();
  return vectors;
}

/// Level 1 of small_chain, rotated and pushed into a floor and a box.
struct Pressed {
  const MassSpringModel& model = small_chain().levels[1].model;
  ContactPoints points{model, contact_skin(small_chain(), 1)};
  std::vector<Obstacle> obstacles{floor(1e6, 0.5), floor(2e5, 0.2)};
  std::vector<Vec3> x = model.rest;

  Pressed() {
    const Box3 box = bounds(model.rest);
    std::get<Plane>(obstacles[0].shape).offset = box.min().z() + 0.02;
    obstacles[1].shape = SolidBox{.center = box.max(),
                                  .half_size = {0.2, 0.15, 0.25},
                                  .rotation = Eigen::AngleAxisd(0.3, Vec3::UnitX()).matrix()};
    const auto shift = random_vectors(x.size(), 0.003, 5);
    for (std::size_t i = 0; i < x.size(); ++i) x[i] += shift[i];
  }
  std::vector<Contact> contacts_at(const std::vector<Vec3>& at) const {
    ContactFinder finder(points, obstacles, x);
    std::vector<Contact> contacts;
    finder.find(at, std::vector<Vec3>(at.size(), Vec3::Zero()), x, contacts);
    return contacts;
  }
};

double kinetic(const MassSpringModel& model, const std::vector<Vec3>& v) {
  double sum = 0;
  for (std::size_t i = 0; i < v.size(); ++i) sum += 0.5 * model.mass[i] * v[i].squaredNorm();
  return sum;
}

}  // namespace

TEST_CASE("A level touches an obstacle where its base does, whichever way the body is turned") {
  const LodChain chain = lod::simplify(
      block(9, 8, 7, 0.1, material("m", 1e6, 1000, 0.002), voxelize::LatticeStyle::corners),
      {.levels = 2});
  const MassSpringModel& base = chain.levels[0].model;
  const double spacing = mean_spring_length(base);
  const auto lowest = [](const std::vector<Vec3>& points, const Vec3& up) {
    double least = std::numeric_limits<double>::infinity();
    for (const Vec3& point : points) least = std::min(least, up.dot(point));
    return least;
  };
  for (std::uint32_t level = 1; level <= 2; ++level) {
    const std::vector<Vec3> points =
        interpolate(contact_skin(chain, level).of_nodes, chain.levels[level].model.rest);
    for (const Vec3& direction : random_vectors(100, 1, 8)) {
      const Vec3 up = direction.normalized();
      CAPTURE(level, up.transpose());
      CHECK(std::abs(lowest(points, up) - lowest(base.rest, up)) < 0.05 * spacing);
    }
  }
}

TEST_CASE("A level's skin carries every affine motion to the base's surface, areas and all") {
  const auto grouping = GENERATE(lod::Grouping::standard, lod::Grouping::compact);
  const auto seed = GENERATE(1, 2, 3);
  const auto level = GENERATE(1U, 2U);
  lod::SimplifyOptions options{.levels = 2};
  options.grouping.grouping = grouping;
  options.grouping.seed = static_cast<std::uint64_t>(seed);
  const LodChain chain = lod::simplify(two_material_block(6), options);
  const MassSpringModel& base = chain.levels[0].model;
  const MassSpringModel& model = chain.levels[level].model;
  const ContactPoints points(model, contact_skin(chain, level));
  Mat3 affine;
  affine << 1.1, 0.3, -0.2, 0.4, 0.7, 0.1, -0.3, 0.2, 1.4;
  const Vec3 shift(0.2, -0.1, 0.5);
  std::vector<Vec3> x;
  for (const Vec3& rest : model.rest) x.emplace_back(affine * rest + shift);
  const double spacing = mean_spring_length(base);
  double area = 0;
  Vec3 moment = Vec3::Zero();
  for (std::uint32_t p = 0; p < points.count(); ++p) {
    const Vec3 at = points.interpolate(p, x);
    // Patches lie in one group, so their means are near each of their nodes.
    CHECK((affine.inverse() * (at - shift) - base.rest[points.number(p)]).norm() <
          2 * static_cast<double>(level + 1) * spacing);
    moment += points.area(p) * at;
    area += points.area(p);
  }
  for (std::uint32_t i = 0; i < base.node_count(); ++i)
    moment -= base.contact_area[i] * (affine * base.rest[i] + shift);
  CHECK(moment.norm() < 1e-9 * area * bounds(base.rest).sizes().norm());
  double wanted = 0;
  for (const double a : base.contact_area) wanted += a;
  CHECK(area == Approx(wanted));
}

TEST_CASE("The contact of the skin has the surface compliance that merging removed") {
  // Three nodes: the first two are merged, the third stays single.
  MassSpringModel base = test::table_model({{0, 0, 0}, {1, 0, 0}, {0, 0, -1}}, {1, 3, 2},
                                           {{0, 1, 100}, {0, 2, 300}, {1, 2, 200}});
  base.contact_area = {0.1, 0.1, 0.1};
  for (std::uint32_t s = 0; s < base.spring_count(); ++s)
    base.damping[s] = 0.01 * base.stiffness[s];
  LodChain chain;
  chain.levels.resize(2);
  chain.levels[0].model = base;
  chain.levels[0].of_base = identity_groups(3);
  chain.levels[1].of_base = {{0, 0, 1}, 2};
  MassSpringModel& level = chain.levels[1].model;
  level = test::table_model({{0.75, 0, 0}, {0, 0, -1}}, {4, 2}, {{0, 1, 500}});
  level.damping[0] = 0.01 * 500;
  const ContactSkin skin = contact_skin(chain, 1);
  // The mean spring direction of node 0 is (1, 0, -3) / sqrt(10), and its stiffness along it is
  // (100 + 9 * 300) / 10 N/m. It lost 3/4 of its degrees of freedom; the pair keeps the rest.
  const Mat3& compliance = skin.compliance[0];
  CHECK((compliance - compliance.transpose()).norm() < 1e-12 * compliance.norm());
  CHECK(Eigen::SelfAdjointEigenSolver<Mat3>(compliance).eigenvalues()[0] >= 0.19 * 0.75 / 280);
  CHECK(skin.compliance[2].isZero(0));
  // The two nodes of the point do not show how it turns: its compliance is the mean of all
  // directions.
  const double mean = compliance.trace() / 3;
  const ContactPoints points(level, skin);
  const ContactPoints::Yielding yielding = points.yielding(0, Vec3::UnitX(), Mat3::Identity());
  CHECK(yielding.normal == Approx(mean));
  CHECK(yielding.tangential == Approx(mean));
  CHECK(yielding.sideways.norm() < 1e-12 * mean);
  CHECK(points.yielding(2, Vec3::UnitX(), Mat3::Identity()).normal == 0);
  Obstacle mat;
  mat.stiffness = 1000;
  mat.damping = 0.002;
  CHECK(points.stiffness(0, mat, mean) == Approx(1 / (1 / 100. + mean)));
  CHECK(points.stiffness(2, mat, 0) == Approx(100));
  const double given = points.stiffness(0, mat, mean) * mean;
  CHECK(points.damping(0, mat, mean) == Approx((1 - given) * 0.002 + given * 0.01));
  CHECK(points.damping(2, mat, 0) == 0.002);
  mat.stiffness.reset();  // from the body
  // By its weight it would need 1.2e5 N/m, more than four times the stiffness of the node.
  CHECK(points.stiffness(0, mat, mean) == Approx(1 / (1 / (4 * 280.) + mean)));
  for (const Mat3& of_base : contact_skin(chain, 0).compliance) CHECK(of_base.isZero(0));
}

TEST_CASE("A force on the skin is the same force and torque on the nodes") {
  const Pressed body;
  const auto forces = random_vectors(body.points.count(), 1, 9);
  std::vector<Vec3> on_nodes(body.x.size(), Vec3::Zero());
  Vec3 force = Vec3::Zero();
  Vec3 torque = Vec3::Zero();
  for (std::uint32_t p = 0; p < body.points.count(); ++p) {
    body.points.add_force(p, forces[p], on_nodes);
    force += forces[p];
    torque += body.points.interpolate(p, body.x).cross(forces[p]);
  }
  for (std::size_t i = 0; i < on_nodes.size(); ++i) {
    force -= on_nodes[i];
    torque -= body.x[i].cross(on_nodes[i]);
  }
  CHECK(force.norm() < 1e-12 * static_cast<double>(body.points.count()));
  CHECK(torque.norm() < 1e-12 * static_cast<double>(body.points.count()));
}

TEST_CASE("The force of a skin's contacts is the slope of their energy") {
  const Pressed body;
  const std::vector<Contact> contacts = body.contacts_at(body.x);
  REQUIRE(contacts.size() > 10);
  std::vector<Vec3> force(body.x.size(), Vec3::Zero());
  for (const Contact& c : contacts)
    body.points.add_force(c.point, c.normal_force * c.normal, force);
  const double h = 1e-7;
  for (std::size_t i = 0; i < body.x.size(); ++i)
    for (int axis = 0; axis < 3; ++axis) {
      const auto energy_at = [&](double way) {
        std::vector<Vec3> x = body.x;
        x[i][axis] += way;
        return contact_energy(body.contacts_at(x));
      };
      CHECK(-(energy_at(h) - energy_at(-h)) / (2 * h) ==
            Approx(force[i][axis]).epsilon(1e-4).margin(1e-2));
    }
}

TEST_CASE("Friction on a skin removes the energy it reports, stick springs store a part of it") {
  const Pressed body;
  std::vector<Contact> contacts = body.contacts_at(body.x);
  std::vector<Vec3> v = random_vectors(body.x.size(), 2, 7);
  const double before = kinetic(body.model, v);
  const double taken = apply_friction(body.points, 1e-3, contacts, v);
  CHECK(taken > 0);
  CHECK(kinetic(body.model, v) == Approx(before - taken));
  double held = 0;
  for (const Contact& c : contacts) held += c.stick_energy();
  CHECK(held > 0);
  CHECK(held < taken);
  contacts.resize(1);
  contacts[0].friction = 1e6;
  contacts[0].stick_stiffness = 0;  // without a stick spring, no slip reverses
  apply_friction(body.points, 1e-3, contacts, v);
  const Vec3 left = body.points.interpolate(contacts[0].point, v);
  CHECK((left - contacts[0].normal.dot(left) * contacts[0].normal).norm() < 1e-12);
}

TEST_CASE("A base with the skin of its own is the base without, to the bit", "[long]") {
  const LodChain& chain = small_chain();
  const MassSpringModel& base = chain.levels[0].model;
  Scenario scene = small_scene(0.8);
  SolidBox box;
  box.center = {1, 0, 0};
  box.half_size = {0.2, 1, 0.2};
  scene.obstacles.push_back(scene.obstacles[0]);
  scene.obstacles[1].shape = box;
  for (const Integrator integrator : all_choices<Integrator>()) {
    CAPTURE(to_string(integrator));
    RunOptions options{.integrator = integrator, .step = 2e-4};
    const Trajectory bare = run(base, scene, options);
    options.skin = skin_of(chain, 0);
    const Trajectory skinned = run(base, scene, options);
    REQUIRE(bare.first_contact.has_value());
    CHECK(skinned.first_contact == bare.first_contact);
    if (integrator != Integrator::symplectic_euler) {
      CHECK(skinned.final.x == bare.final.x);
    } else {
      CHECK(largest_difference(skinned.final.x, bare.final.x) < 1e-9);
    }
    CHECK(skinned.ledger.back().total() == Approx(bare.ledger.back().total()).epsilon(1e-9));
  }
}

TEST_CASE("A level dropped flat comes to the floor when its base does, at the base's height") {
  const LodChain chain = lod::simplify(ball(), {.levels = 2});
  Scenario scene;
  scene.obstacles = {floor(1e6, 0.5)};
  scene.start.placed = true;
  scene.start.position = {0, 0, 0.6};
  scene.duration = 0.3;
  CompareOptions options{.run = {.step = 2e-4}, .contact = ContactAt::surface};
  const Comparison skinned = compare(chain, scene, options);
  options.contact = ContactAt::nodes;
  const Comparison bare = compare(chain, scene, options);
  const double at = skinned.levels[0].first.first_contact.value();
  CHECK(bare.levels[0].first.first_contact == at);
  for (std::size_t level = 1; level < 3; ++level) {
    CHECK(skinned.levels[level].first.first_contact.value() == Approx(at).margin(3e-4));
    CHECK(std::abs(bare.levels[level].first.first_contact.value() - at) > 3e-3);
  }
}

TEST_CASE("A level with a skin bounces and slides with its energy account closed") {
  const LodChain& chain = small_chain();
  Scenario scene = small_scene(1.5);
  scene.obstacles[0].damping = GENERATE(0.0, 1e-4);
  const auto integrator = GENERATE(Integrator::symplectic_euler, Integrator::velocity_verlet);
  for (const std::uint32_t level : {1U, 2U}) {
    CAPTURE(level, to_string(integrator));
    const Trajectory t = run(chain.levels[level].model, scene,
                             {.integrator = integrator, .skin = skin_of(chain, level)});
    CHECK(closure_error(t.ledger) < 0.01);
    CHECK(t.ledger.back().lost_friction > 0);
  }
}

TEST_CASE("A level with a skin may change its step, its energy account stays closed") {
  const LodChain& chain = small_chain();
  const MassSpringModel& model = chain.levels[1].model;
  const Scenario scene = small_scene(1.5);
  const auto skin = skin_of(chain, 1);
  const double step = 0.5 * predicted_step(model);
  FastLeapfrog body(model, scene, initial_state(model, scene.start), step, {.skin = skin});
  body.prepare();
  const double energy = body.ledger_entry().total();
  bool gripped = false;
  for (int i = 0; i < 40; ++i) {
    body.advance(60);
    for (const Contact& c : body.contacts()) gripped = gripped || c.stick_energy() > 0;
    REQUIRE(body.change_step(i % 2 == 0 ? step / 2 : step));
  }
  CHECK(gripped);
  CHECK(body.ledger_entry().total() == Approx(energy).epsilon(2e-3));
}

TEST_CASE("The predicted step of a level with a skin holds on a stiff floor") {
  const LodChain& chain = small_chain();
  Scenario scene;
  scene.obstacles = {floor(1e9, 0.3)};
  scene.start.placed = true;
  scene.start.position = {0, 0, 0.15};
  scene.start.spin = {0.2, 0.3, 0};
  scene.duration = 0.3;
  ContactSkin hard = contact_skin(chain, 2);
  // Only the stiffness of the contact.
  std::fill(hard.compliance.begin(), hard.compliance.end(), Mat3(Mat3::Zero()));
  const auto skin = std::make_shared<ContactSkin>(hard);
  const MassSpringModel& model = chain.levels[2].model;
  const auto integrator = GENERATE(Integrator::symplectic_euler, Integrator::runge_kutta_4);
  const double step = predicted_step(model, integrator);
  CHECK_NOTHROW(run(model, scene, {.integrator = integrator, .step = 0.95 * step, .skin = skin}));
}

TEST_CASE("The implicit schemes bring a level with a skin to the same rest as the explicit ones") {
  const LodChain& chain = small_chain();
  const MassSpringModel& model = chain.levels[1].model;
  Scenario scene;
  scene.obstacles = {floor(1e6, 0.5)};
  scene.obstacles[0].damping = 0.02;
  scene.start.placed = true;
  scene.start.position = {0, 0, 0.15};
  scene.duration = 1;
  RunOptions options{.skin = skin_of(chain, 1)};
  const double rest = center_of_mass(model, run(model, scene, options).final.x).z();
  for (const Integrator integrator : all_choices<Integrator>()) {
    if (!is_implicit(integrator)) continue;
    CAPTURE(to_string(integrator));
    options.integrator = integrator;
    const Trajectory t = run(model, scene, options);
    CHECK(t.unconverged_steps == 0);
    CHECK(center_of_mass(model, t.final.x).z() == Approx(rest).margin(2e-4));
  }
}

TEST_CASE("A skin that goes through a wall is stopped, by the base's node, under every scheme") {
  const LodChain& chain = small_chain();
  Scenario scene = weightless(0.1);
  scene.obstacles = {floor(1e5, 0)};
  scene.obstacles[0].name = "thin wall";
  scene.obstacles[0].shape = SolidBox{{0.7, 0.2, 0.2}, {0.001, 2, 2}, Mat3::Identity()};
  scene.start.velocity = {40, 0, 0};
  for (const Integrator integrator :
       {Integrator::symplectic_euler, Integrator::velocity_verlet, Integrator::runge_kutta_4}) {
    CAPTURE(to_string(integrator));
    try {
      run(chain.levels[1].model, scene,
          {.integrator = integrator, .step = 2e-4, .skin = skin_of(chain, 1)});
      FAIL("no point went through");
    } catch (const TunnelError& e) {
      CHECK_THAT(e.what(),
                 Catch::Contains("the surface at node " + std::to_string(script_number(e.node())) +
                                 " of the base went through obstacle \"thin wall\""));
      CHECK(e.node() < chain.levels[0].model.node_count());
    }
  }
}

TEST_CASE("A skin of another model or of no level is refused") {
  const LodChain& chain = small_chain();
  CHECK_THROWS_AS(contact_skin(chain, 3), InputError);
  const Scenario scene = small_scene(0.1);
  CHECK_THROWS_AS(run(chain.levels[2].model, scene, {.skin = skin_of(chain, 1)}), InputError);
  ContactSkin skin = contact_skin(chain, 1);
  skin.area[0] = 0;
  CHECK_THROWS_AS(validate(skin, chain.levels[1].model.node_count()), InputError);
  skin = contact_skin(chain, 1);
  skin.compliance[0](1, 1) = -1;
  CHECK_THROWS_AS(validate(skin, chain.levels[1].model.node_count()), InputError);
  skin = contact_skin(chain, 1);
  skin.compliance[0](0, 1) += 1;
  CHECK_THROWS_AS(validate(skin, chain.levels[1].model.node_count()), InputError);
  skin = contact_skin(chain, 1);
  skin.base_node.pop_back();
  CHECK_THROWS_AS(validate(skin, chain.levels[1].model.node_count()), InputError);
}

TEST_CASE("Fast steps with a skin are those of the plain kernel, whatever the layout") {
  const auto precision = GENERATE(Precision::double_precision, Precision::single_precision);
  const LodChain chain = lod::simplify(two_material_block(9), {.levels = 1});
  const MassSpringModel& model = chain.levels[1].model;
  const Scenario scene = rough_scene(chain.levels[0].model);
  const auto skin = skin_of(chain, 1);
  constexpr std::uint64_t kSteps = 300;
  const Outcome plain = after<Leapfrog>(model, scene, kSteps, {.skin = skin}, 1);
  REQUIRE(plain.contacts > 0);
  REQUIRE(plain.ledger.lost_friction > 0);
  const Outcome fast =
      after<FastLeapfrog>(model, scene, kSteps, {.precision = precision, .skin = skin}, 1);
  const bool exact = precision == Precision::double_precision;
  const double size = bounds(model.rest).sizes().norm();
  CHECK(largest_difference(plain.state.x, fast.state.x) < (exact ? 1e-9 : 1e-4) * size);
  CHECK(fast.first_contact.value() == Approx(plain.first_contact.value()));
  CHECK(fast.ledger.total() == Approx(plain.ledger.total()).epsilon(exact ? 1e-8 : 1e-3));
  if (!exact) return;
  CHECK(fast.contacts == plain.contacts);
  for (const auto part : {&LedgerEntry::contact, &LedgerEntry::lost_friction,
                          &LedgerEntry::lost_contact, &LedgerEntry::lost_damping})
    CHECK(fast.ledger.*part ==
          Approx(plain.ledger.*part).margin(1e-8 * std::abs(plain.ledger.total())));
}

TEST_CASE("Fast steps with a skin give the same bits at any stride, on any number of threads",
          "[threaded]") {
  const LodChain chain = lod::simplify(two_material_block(33), {.levels = 1});
  const MassSpringModel& model = chain.levels[1].model;
  REQUIRE(model.node_count() > 16'000);  // worth two threads
  const Scenario scene = rough_scene(chain.levels[0].model);
  const auto skin = skin_of(chain, 1);
  const auto with = [&](std::uint32_t threads, std::uint64_t stride) {
    return after<FastLeapfrog>(model, scene, 70, {.threads = threads, .skin = skin}, stride);
  };
  const Outcome one = with(1, 1000);
  REQUIRE(one.contacts > 0);
  check_same_bits(one, with(1, 7));
  check_same_bits(one, with(2, 1000));
  CHECK(largest_difference(after<Leapfrog>(model, scene, 70, {.skin = skin}, 1).state.x,
                           one.state.x) < 1e-11);
}
