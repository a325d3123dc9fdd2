// Corners without springs: what the correction of a step does to them.

#include "sim/correction/step_corners.hpp"

#include <cmath>
#include <limits>
#include <random>

#include <catch2/catch.hpp>

#include "sim/correction/plain_correction.hpp"
#include "sim/run/step_watch.hpp"
#include "tests/sim/correction/throws.hpp"
#include "tests/support/lattices.hpp"
#include "tests/support/models.hpp"

using namespace springlod;
using namespace springlod::sim;

namespace {

constexpr double kEdge = 0.02;  // [m]

/// A corner of nodes of different masses, and without area.
MassSpringModel one_corner() {
  MassSpringModel model = test::make_model({{0, 0, 0}, {kEdge, 0, 0}, {0, kEdge, 0}, {0, 0, kEdge}},
                                           {{0, 1}, {0, 2}, {0, 3}});
  model.mass = {1e-3, 2e-3, 0.7e-3, 1.5e-3};
  model.corners = {Corner{{0, 1, 2, 3}, 2e5}};
  return model;
}

/// A body without springs.
struct Loose {
  explicit Loose(const MassSpringModel& of_model, const std::vector<Obstacle>& obstacles = {})
      : model(of_model),
        points(model),
        finder(points, obstacles, model.rest),
        correction(model, points, finder, obstacles.size(), true, {}),
        x(model.rest),
        v(model.node_count(), Vec3::Zero()) {}

  void advance(double step) {
    std::vector<Vec3> x_next = x;
    for (std::size_t i = 0; i < x.size(); ++i) x_next[i] += step * v[i];
    correction.correct(step, x, x_next, v);
    x = x_next;
    const StepCorrection::Losses& losses = corners().losses();
    lost_corners += losses.corners;
    lost_contact += losses.contact + losses.friction;
    for (const NodeChange& change : corners().changes())
      largest_move = std::max(largest_move, change.by_corners.norm());
  }
  const StepCorrection& corners() const { return correction.solver(); }
  double ratio(std::uint32_t corner) const {
    return corner_volume(model.corners[corner], x) /
           corner_volume(model.corners[corner], model.rest);
  }
  double kinetic() const {
    double sum = 0;
    for (std::size_t i = 0; i < v.size(); ++i) sum += 0.5 * model.mass[i] * v[i].squaredNorm();
    return sum;
  }
  /// With the energy of the corners that the correction knows to resist [J].
  double energy() const {
    return kinetic() + corner_energy(model, corners().resisting(), x) +
           contact_energy(corners().now()) + lost_corners + lost_contact;
  }
  Vec3 momentum() const {
    Vec3 sum = Vec3::Zero();
    for (std::size_t i = 0; i < v.size(); ++i) sum += model.mass[i] * v[i];
    return sum;
  }
  Vec3 angular_momentum() const {
    Vec3 sum = Vec3::Zero();
    for (std::size_t i = 0; i < v.size(); ++i) sum += model.mass[i] * x[i].cross(v[i]);
    return sum;
  }

  MassSpringModel model;
  ContactPoints points;
  ContactFinder finder;
  PlainCorrection correction;
  std::vector<Vec3> x;
  std::vector<Vec3> v;
  double lost_corners = 0;
  double lost_contact = 0;
  double largest_move = 0;  // of a node by corners in one step [m]
};

/// Inertia of J [kg m2] for displacements along its gradient at rest: its rate q has the kinetic
/// energy inertia q^2 / 2.
double inertia_of(const MassSpringModel& model) {
  const CornerNodes at{model.rest[0], model.rest[1], model.rest[2], model.rest[3]};
  const double volume = volume_at(at);
  double sum = 0;
  for (std::size_t i = 0; i < 4; ++i)
    sum += (volume_gradient(at)[i] / volume).squaredNorm() / model.mass[i];
  return 1 / sum;
}

/// Velocities along the gradient with which J changes at the rate `rate` [1/s].
void push(Loose& body, double rate) {
  const CornerNodes at{body.x[0], body.x[1], body.x[2], body.x[3]};
  const CornerNodes gradient = volume_gradient(at);
  const double inertia = inertia_of(body.model);
  for (std::size_t i = 0; i < 4; ++i)
    body.v[i] += rate * inertia / body.model.mass[i] * gradient[i] / volume_at(at);
}

/// The rate of J [1/s] whose kinetic energy is what the corner stores until it is flat.
double stopping_rate(const MassSpringModel& model) {
  const double stiffness =
      corner_stiffness(model.corners[0], corner_volume(model.corners[0], model.rest));
  return kCornerResists * std::sqrt(stiffness / inertia_of(model));
}

}  // namespace

TEST_CASE("A corner is turned back before it is flat, energy and momenta add up in each step") {
  const MassSpringModel model = one_corner();
  const double speed = GENERATE(0.3, 0.7, 1.0);  // of what its energy can stop, without damping
  const bool spins = GENERATE(false, true);
  Loose body(model);
  const double rate = speed * stopping_rate(model);
  push(body, -rate);
  for (std::size_t i = 0; spins && i < 4; ++i)
    body.v[i] += Vec3(1, 2, -1) + Vec3(20, -10, 30).cross(model.rest[i]);
  const double step = StepController::kCornerChange / rate;
  const double energy = body.energy();
  const Vec3 momentum = body.momentum();
  const Vec3 angular = body.angular_momentum();
  const double total_mass = mass_properties(model).mass;
  const double momentum_scale = std::sqrt(2 * energy * total_mass);
  double least = 1;
  CAPTURE(speed, spins);
  for (int i = 0; i < 500; ++i) {
    const bool pressed = !body.corners().resisting().empty();
    body.advance(step);
    least = std::min(least, body.ratio(0));
    CHECK(body.energy() == Approx(energy).epsilon(1e-13));
    // A kick is 2 / step times the difference of two positions, each of which is rounded.
    const double rounding = 2 * std::numeric_limits<double>::epsilon() * kEdge / step;  // [m/s]
    CHECK((body.momentum() - momentum).norm() <
          (i + 1) * total_mass * rounding + 1e-14 * momentum_scale);
    CHECK((body.angular_momentum() - angular).norm() <
          1e-12 * momentum_scale * (kEdge + i * step * momentum_scale / total_mass));
    if (pressed && body.corners().resisting().empty()) break;  // let go; nothing else holds it
  }
  CHECK(least > 0.2);
  CHECK(least < kCornerResists);
  CHECK(body.ratio(0) > 0.95 * kCornerResists);
  CHECK(body.lost_corners > 0);
  CHECK(body.kinetic() < energy);
}

TEST_CASE("A corner that is inside out at rest is turned back in some steps, and not thrown") {
  const MassSpringModel model = one_corner();
  const double ratio = GENERATE(-0.7, -0.3, 0.0, 0.2);
  const double fraction = GENERATE(0.05, 0.3, 3.0);  // step in units of 1 / frequency of the corner
  Loose body(model);
  body.x[3].z() *= ratio;
  const double stiffness =
      corner_stiffness(model.corners[0], corner_volume(model.corners[0], model.rest));
  const double step = fraction * std::sqrt(inertia_of(model) / stiffness);
  CAPTURE(ratio, fraction);
  int steps = 0;
  while (body.ratio(0) < 0.95 * kCornerResists && steps < 1000) {
    body.advance(step);
    ++steps;
  }
  CHECK(steps < 30 / std::min(1.0, fraction));
  CHECK(body.largest_move <= 0.25 * kEdge * (1 + 1e-12));
  const double stored = 0.5 * stiffness * std::pow(kCornerResists - ratio, 2);
  CHECK(body.kinetic() < stored);
  CHECK(body.momentum().norm() < 1e-12 * std::sqrt(2 * stored * mass_properties(model).mass));
}

TEST_CASE("A corner that another one presses resists in the same step") {
  // Two corners back to back. The upper one is thrown together and presses the lower one, which
  // would not resist by itself.
  MassSpringModel model =
      test::make_model({{0, 0, 0}, {kEdge, 0, 0}, {0, kEdge, 0}, {0, 0, kEdge}, {0, 0, -kEdge}},
                       {{0, 1}, {0, 2}, {0, 3}, {0, 4}});
  model.mass.assign(5, 1e-3);
  model.corners = {Corner{{0, 1, 2, 3}, 2e5}, Corner{{0, 1, 4, 2}, 2e5}};
  Loose body(model);
  body.x[4].z() *= 1.001 * kCornerResists;
  body.x[3].z() *= 1.001 * kCornerResists;
  body.v[3].z() = -1;
  const double energy = body.energy();
  body.advance(2e-3);
  CHECK(body.x[4].z() < -1.002 * kCornerResists * kEdge);
  CHECK(body.ratio(1) > kCornerResists);
  CHECK(body.energy() == Approx(energy).epsilon(1e-13));
}

TEST_CASE("The energy of a corner that resists at the start counts from the start") {
  const MassSpringModel model = one_corner();
  Loose body(model);
  body.x[3].z() *= 0.1;
  const double energy = corner_energy(model, body.x);
  for (int i = 0; i < 100; ++i) body.advance(1e-5);
  CHECK(body.energy() == Approx(energy).epsilon(1e-13));
}

TEST_CASE("A corner whose nodes lie in one place does not move them, and is found") {
  MassSpringModel model = one_corner();
  Loose body(model);
  for (Vec3& x : body.x) x = Vec3::Zero();
  body.advance(1e-3);
  for (const Vec3& x : body.x) CHECK(x == Vec3::Zero());
  CHECK(body.corners().inverted() == std::vector<std::uint32_t>{0});
}

TEST_CASE("Energy, stored and lost, adds up in every step of many corners and contacts") {
  const std::uint32_t level = GENERATE(0U, 1U);
  const bool touches = GENERATE(false, true);
  static const LodChain chain = test::soft_bar(0);
  const MassSpringModel& model = chain.levels[level].model;
  std::vector<Obstacle> ground{test::floor(1e7, 0.5)};
  std::get<Plane>(ground[0].shape).offset = bounds(model.rest).min().z() - 1e-3;
  if (!touches) ground.clear();
  Loose body(model, ground);
  // Without springs, the body is pressed together towards its middle, and then flies apart.
  const Vec3 middle = bounds(model.rest).center();
  std::mt19937_64 random(1);
  for (std::size_t i = 0; i < body.x.size(); ++i) {
    const Vec3 jitter(test::uniform(random), test::uniform(random), test::uniform(random));
    body.v[i] = -60 * (body.x[i] - middle) + 2 * jitter - Vec3(1, 1, touches ? 12 : 1);
  }
  const double energy = body.energy();
  const Vec3 momentum = body.momentum();
  const double scale = std::sqrt(2 * energy * mass_properties(model).mass);
  std::size_t resisting = 0;
  std::size_t contacts = 0;
  CAPTURE(level, touches);
  for (int i = 0; i < 100; ++i) {
    body.advance(2e-4);
    CHECK(body.energy() == Approx(energy).epsilon(1e-12));
    if (!touches) CHECK((body.momentum() - momentum).norm() < 1e-12 * scale);
    resisting += body.corners().resisting().size();
    contacts += body.corners().now().size();
  }
  CHECK(resisting > 1000);
  CHECK((contacts > 100) == touches);
  CHECK(body.lost_corners > 0.05 * energy);
}
