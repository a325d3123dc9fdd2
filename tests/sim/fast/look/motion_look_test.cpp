// Strains and departures of fast layouts, compared with plain loops over the model.

#include <algorithm>
#include <cmath>
#include <random>

#include <catch2/catch.hpp>

#include "sim/fast/rigid_motion.hpp"
#include "tests/sim/fast/look/posed.hpp"

using namespace springlod;
using namespace springlod::sim;
using namespace springlod::test;

TEST_CASE("The largest strain is that of a plain loop over the springs") {
  const auto precision = GENERATE(Precision::single_precision, Precision::double_precision);
  const double near = precision == Precision::single_precision ? 2e-5 : 1e-12;
  std::mt19937_64 random(3);
  for (const auto& [name, subject] : subjects()) {
    CAPTURE(name, precision);
    const MassSpringModel& model = subject.model;
    const Posed rest(subject, precision, model.rest);
    CHECK(rest.largest_strain() == Approx(plain_strain(model, model.rest)).margin(near));
    const std::vector<Vec3> jittered = displaced(model, 0.1, random);
    for (const double scale : {0.6, 1.0, 1.4}) {  // compression or stretch decides
      std::vector<Vec3> x = jittered;
      for (Vec3& each : x) each *= scale;
      CHECK(Posed(subject, precision, x).largest_strain() ==
            Approx(plain_strain(model, x)).margin(near));
    }
    // Springs within blocks and between them.
    for (std::uint32_t n = 0; n < 20; ++n) {
      const auto s = static_cast<std::uint32_t>(uniform(random) * model.spring_count());
      std::vector<Vec3> x = model.rest;
      x[model.a[s]] = x[model.b[s]] + 3 * (x[model.a[s]] - x[model.b[s]]);
      CHECK(Posed(subject, precision, x).largest_strain() ==
            Approx(plain_strain(model, x)).margin(near));
    }
  }
}

TEST_CASE("The largest departure leaves out a rigid motion, and nodes that do not count") {
  const auto precision = GENERATE(Precision::single_precision, Precision::double_precision);
  const double near = precision == Precision::single_precision ? 1e-6 : 1e-14;
  const RigidMotion rigid{.velocity = {-2, 3, 1}, .spin = {20, -30, 10}};
  constexpr double kDrift = 1e-4;
  constexpr std::uint32_t kEvery = 7;  // a node that does not count
  std::mt19937_64 random(4);
  for (const auto& [name, subject] : subjects()) {
    CAPTURE(name, precision);
    const std::vector<Vec3>& rest = subject.model.rest;
    const Vec3 center = bounds(rest).center();
    std::vector<Vec3> v;
    for (const Vec3& x : rest) v.push_back(rigid.at(x - center) + 0.01 * random_vector(random));
    for (std::size_t i = 0; i < v.size(); i += kEvery) v[i] *= 2;
    const Posed posed(subject, precision, rest, v);
    FastBody& body = *posed.body;
    std::vector<Vec3> x(rest.size());
    for (const bool counts : {true, false, true}) {
      for (std::uint32_t i = 0; i < v.size(); i += kEvery) body.count_departures({&i, 1}, counts);
      for (const RigidMotion& motion : {RigidMotion(), rigid}) {
        body.set_rigid_motion(motion);
        for (std::uint32_t b = 0; b < body.block_count(); ++b) {
          const Vec3 before = body.largest_departure(b);
          body.move(b, 1, 0);  // no forces yet
          CHECK(body.largest_departure(b) == before);
          body.move(b, 0, kDrift);
          body.get_x(b, posed.frame, x);
          Vec3 expected = Vec3::Zero();
          for (const std::uint32_t node : body.nodes(b))
            if (counts || node % kEvery != 0)
              expected =
                  expected.cwiseMax((kDrift * (v[node] - motion.at(x[node] - center))).cwiseAbs());
          CHECK((body.largest_departure(b) - expected).norm() <=
                near * body.largest_displacement(b).norm());
          CHECK(expected.norm() > 0);
        }
      }
    }
  }
}

TEST_CASE("A rigid motion is fitted to the nodes of a body") {
  const auto precision = GENERATE(Precision::single_precision, Precision::double_precision);
  const double near = precision == Precision::single_precision ? 1e-5 : 1e-12;
  const RigidMotion rigid{.velocity = {-2, 3, 1}, .spin = {20, -30, 10}};
  std::mt19937_64 random(9);
  for (const auto& [name, subject] : subjects()) {
    CAPTURE(name, precision);
    const std::vector<Vec3>& rest = subject.model.rest;
    const Vec3 center = bounds(rest).center();
    for (const double noise : {0.0, 0.1}) {
      std::vector<Vec3> v;
      for (const Vec3& x : rest) v.push_back(rigid.at(x - center) + noise * random_vector(random));
      const Posed posed(subject, precision, rest, v);
      const RigidMotion fit = RigidFit(subject.model.node_count()).fit(*posed.body);
      double farthest = 0;
      for (const Vec3& x : rest)
        farthest = std::max(farthest, (fit.at(x - center) - rigid.at(x - center)).norm());
      CHECK(farthest <= noise + near * 10);
    }
  }
}

TEST_CASE("The rigid motion of few nodes is one of those that fit") {
  // A line and a single node leave a part of the spin open.
  MassSpringModel line;
  line.rest = {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}};
  line.mass = {1, 1, 1};
  line.a = {0, 1};
  line.b = {1, 2};
  line.stiffness = {1, 1};
  line.rest_length = {1, 1};
  line.damping = {0, 0};
  const Posed posed({line}, Precision::double_precision, line.rest,
                    {{0, 1, 0}, {0, 2, 0}, {0, 3, 0}});
  const RigidMotion fit = RigidFit(3).fit(*posed.body);
  CHECK((fit.spin - Vec3(0, 0, 1)).norm() < 1e-12);
}

TEST_CASE("Looking at a body between its steps does not change them") {
  const auto precision = GENERATE(Precision::single_precision, Precision::double_precision);
  std::mt19937_64 random(6);
  for (const auto& [name, subject] : subjects()) {
    CAPTURE(name, precision);
    const MassSpringModel& model = subject.model;
    const std::vector<Vec3> x = displaced(model, 0.05, random);
    const double step = 0.3 * predicted_step(model);
    const auto after_steps = [&](bool looks) {
      const Posed posed(subject, precision, x);
      FastBody& body = *posed.body;
      if (looks) body.set_rigid_motion({.spin = {1, 2, 3}});
      for (int i = 0; i < 5; ++i) {
        for (std::uint32_t b = 0; b < body.block_count(); ++b) body.find_forces(b);
        for (std::uint32_t b = 0; b < body.block_count(); ++b) {
          body.collect_forces(b);
          body.move(b, step, step);
        }
        if (!looks) continue;
        posed.find_corners(i);
        posed.largest_strain();
      }
      std::vector<Vec3> y(x.size());
      for (std::uint32_t b = 0; b < body.block_count(); ++b) body.get_x(b, posed.frame, y);
      return y;
    };
    CHECK(after_steps(true) == after_steps(false));
  }
}
