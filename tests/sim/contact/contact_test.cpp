#include "sim/contact/contact.hpp"

#include <cmath>
#include <random>

#include <catch2/catch.hpp>

#include "sim/run.hpp"
#include "tests/sim/scenes.hpp"

using namespace springlod;
using namespace springlod::sim;

namespace {

MassSpringModel one_node(double area) {
  MassSpringModel m;
  m.rest = {Vec3::Zero()};
  m.mass = {1};
  m.volume = {1};
  m.contact_area = {area};
  m.border = {1};
  m.material = {0};
  m.materials = {Material{.name = "m"}};
  return m;
}

Obstacle box_obstacle(const SolidBox& box) {
  Obstacle obstacle;
  obstacle.shape = box;
  obstacle.name = "box";
  obstacle.stiffness = 1e5;
  return obstacle;
}

}  // namespace

TEST_CASE("A node is pushed out by kappa times area times depth, damping never pulls") {
  const auto model = one_node(0.02);
  std::vector<Obstacle> obstacles{test::floor(1e5, 0.3)};
  obstacles[0].damping = 0.01;
  const std::vector<Vec3> x{Vec3(0, 0, -0.005)};
  const ContactPoints points(model);
  ContactFinder finder(points, obstacles, x);
  std::vector<Contact> contacts;
  const auto force_at = [&](double vz) {
    finder.find(x, {Vec3(1, 2, vz)}, x, contacts);
    REQUIRE(contacts.size() == 1);
    return contacts[0].normal_force;
  };
  CHECK(force_at(0) == Approx(10));     // 1e5 * 0.02 * 0.005
  CHECK(force_at(-0.2) == Approx(14));  // + 2000 * 0.01 * 0.2
  CHECK(force_at(0.2) == Approx(6));
  CHECK(force_at(3) == 0);
  CHECK(contacts[0].damping_force == Approx(-10));
  CHECK(contact_energy(contacts) == Approx(0.025));  // 1/2 * 2000 * 0.005^2
  finder.find({Vec3(0, 0, 1e-9)}, {Vec3::Zero()}, x, contacts);
  CHECK(contacts.empty());
}

TEST_CASE("Friction slows a slip by at most mu f dt / m and never turns it round") {
  const auto model = one_node(1);
  Contact contact;
  contact.normal_force = 20;
  contact.friction = 0.5;
  std::vector<Contact> contacts{contact};
  const ContactPoints points(model);
  std::vector<Vec3> v{Vec3(3, 4, -7)};
  apply_friction(points, 0.1, contacts, v);  // takes 0.5 * 20 * 0.1 / 1 = 1 of 5
  CHECK((v[0] - Vec3(2.4, 3.2, -7)).norm() < 1e-12);
  apply_friction(points, 1, contacts, v);
  CHECK((v[0] - Vec3(0, 0, -7)).norm() < 1e-12);
  apply_friction(points, 1, contacts, v);
  CHECK((v[0] - Vec3(0, 0, -7)).norm() < 1e-12);
}

TEST_CASE("A stick spring holds the point elastically and slides at mu f") {
  const double mass = 2;
  Contact contact;
  contact.normal_force = 100;
  contact.friction = 10;
  contact.stick_stiffness = 800;  // omega = 20 rad/s: the point stops after pi/40 s, 3 / 20 m away
  const double step = 1e-6;
  Vec3 v(3, 0, -1);
  double time = 0;
  for (; v[0] > 0; time += step) {
    apply_friction(contact, mass, step, v);
    v += contact.slip_change;
  }
  CHECK(time == Approx(std::acos(-1.0) / 40).epsilon(1e-4));
  CHECK(contact.stretch[0] == Approx(3.0 / 20).epsilon(1e-4));
  CHECK(v[2] == -1);
  contact.friction = 0.1;
  v = Vec3(3, 0, -1);
  apply_friction(contact, mass, step, v);
  CHECK(contact.slip_change[0] == Approx(-0.1 * 100 * step / mass));
  CHECK(contact.stretch[0] == Approx(0.1 * 100 / 800));
}

TEST_CASE("An infinitely stiff stick spring holds as friction without one does") {
  Contact bare;
  bare.normal_force = 20;
  bare.friction = 0.5;
  Contact sticking = bare;
  sticking.stick_stiffness = 1e15;
  for (const double step : {1e-3, 0.1, 1.0}) {
    apply_friction(bare, 1, step, {3, 4, -7});
    apply_friction(sticking, 1, step, {3, 4, -7});
    CHECK((sticking.slip_change - bare.slip_change).norm() < 1e-9);
  }
}

TEST_CASE("No stick spring returns more energy than it stored, whatever the step") {
  std::mt19937_64 random(5);
  std::uniform_real_distribution<double> unit(-1, 1);
  const auto vector = [&] { return Vec3(unit(random), unit(random), unit(random)); };
  for (int i = 0; i < 1000; ++i) {
    CAPTURE(i);
    const auto decades = [&](double from, double to) {
      return std::pow(10, from + (to - from) * (unit(random) + 1) / 2);
    };
    Contact contact;
    contact.normal = vector().normalized();
    contact.normal_force = decades(-2, 4);
    contact.friction = decades(-2, 1);
    contact.stick_stiffness = decades(0, 6);
    contact.stick_damping = i % 2 == 0 ? 0 : decades(-4, 0);
    contact.stretch = 0.01 * vector();
    const double mass = decades(-2, 2);
    const Vec3 v = vector();
    apply_friction(contact, mass, decades(-5, 0), v);
    const double taken = -mass * contact.slip_change.dot(v + 0.5 * contact.slip_change);
    CHECK(taken - contact.stick_gain >= -1e-12 * (std::abs(taken) + contact.stick_energy()));
    CHECK(std::abs(contact.normal.dot(contact.slip_change)) < 1e-12);
  }
}

TEST_CASE("A stick spring is kept while its point touches the same obstacle, and no longer") {
  const auto at = [](std::uint32_t obstacle, std::uint32_t point, double stretch) {
    Contact contact;
    contact.obstacle = obstacle;
    contact.point = point;
    contact.stretch = Vec3(stretch, 0, 0);
    return contact;
  };
  std::vector<Contact> now{at(0, 2, 0), at(0, 5, 0), at(1, 2, 0), at(1, 4, 0)};
  keep_stick_springs({at(0, 1, 1), at(0, 5, 2), at(0, 6, 3), at(1, 2, 4)}, now);
  CHECK(now[0].stretch[0] == 0);
  CHECK(now[1].stretch[0] == 2);
  CHECK(now[2].stretch[0] == 4);
  CHECK(now[3].stretch[0] == 0);
}

TEST_CASE("A node pressed past the middle of a thin box goes back where it came from") {
  SolidBox plate;
  plate.half_size = {1, 1, 0.01};
  plate.rotation = Eigen::AngleAxisd(0.4, Vec3::UnitY()).toRotationMatrix();
  const auto model = one_node(1);
  const std::vector<Obstacle> obstacles{box_obstacle(plate)};
  const Vec3 out = plate.rotation.col(2);
  const ContactPoints points(model);
  ContactFinder finder(points, obstacles, {0.02 * out});
  std::vector<Contact> contacts;
  for (const double height : {0.011, 0.009, 0.003, -0.003, -0.009, -0.012}) {
    finder.find({height * out}, {Vec3::Zero()}, {height * out}, contacts);
    REQUIRE(contacts.size() == (height < 0.01 ? 1 : 0));
    if (contacts.empty()) continue;
    CHECK(contacts[0].depth == Approx(0.01 - height));
    CHECK((contacts[0].normal - out).norm() < 1e-12);
  }
  // A point that started below the same plate is pushed down.
  ContactFinder from_below(points, obstacles, {-0.02 * out});
  from_below.find({-0.003 * out}, {Vec3::Zero()}, {-0.003 * out}, contacts);
  REQUIRE(contacts.size() == 1);
  CHECK((contacts[0].normal + out).norm() < 1e-12);
}

TEST_CASE("The depth in a box never jumps while a node slides across its top and over an edge") {
  SolidBox box;
  box.half_size = {0.5, 0.3, 0.2};
  const auto model = one_node(1);
  const std::vector<Obstacle> obstacles{box_obstacle(box)};
  const double step = 1e-3;
  Vec3 at(-0.45, -0.25, 0.21);
  const ContactPoints points(model);
  ContactFinder finder(points, obstacles, {at});
  std::vector<Contact> contacts;
  double before = 0;
  const auto go_on = [&] {
    finder.find({at}, {Vec3::Zero()}, {at}, contacts);
    const double depth = contacts.empty() ? 0 : contacts[0].depth;
    CHECK(std::abs(depth - before) <= 1.5 * step);
    before = depth;
  };
  while (at.z() > 0.15) at.z() -= step, go_on();
  CHECK(before > 0.04);
  while (at.x() < 0.6) at += Vec3(step, 0.4 * step, 0), go_on();
  CHECK(before == 0);
}

TEST_CASE("A ball bounces off a thin turned plate and keeps its energy account") {
  SolidBox plate;
  plate.half_size = {0.05, 2, 2};
  plate.center = {1.2, 0, 0};
  plate.rotation = Eigen::AngleAxisd(0.2, Vec3::UnitZ()).toRotationMatrix();
  Scenario scene;
  scene.gravity = Vec3::Zero();
  scene.obstacles = {box_obstacle(plate)};
  scene.obstacles[0].stiffness = 1e6;
  scene.start.velocity = {4, 0, 0};
  scene.duration = 1;
  const auto model = test::ball();
  const auto t = run(model, scene);
  CHECK(t.first_contact.has_value());
  Vec3 v = Vec3::Zero();
  for (std::uint32_t i = 0; i < model.node_count(); ++i) v += model.mass[i] * t.final.v[i];
  CHECK(v.x() < 0);
  for (const Vec3& x : t.final.x) CHECK(surface_distance(scene.obstacles[0], x).distance > 0);
  CHECK(closure_error(t.ledger) < 0.01);
}
