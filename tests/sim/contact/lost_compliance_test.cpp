#include "sim/contact/lost_compliance.hpp"

#include <algorithm>
#include <cmath>

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <catch2/catch.hpp>

#include "elastic/elastic_body.hpp"
#include "elastic/loads.hpp"
#include "lod/build.hpp"
#include "sim/contact/contact.hpp"
#include "sim/contact/contact_points.hpp"
#include "sim/contact/contact_skin.hpp"
#include "sim/run.hpp"
#include "tests/sim/scenes.hpp"
#include "tests/support/bodies.hpp"

using namespace springlod;
using namespace springlod::sim;

namespace {

/// Groups of about two and five nodes of a block of firm material.
LodChain compact_levels() {
  lod::SimplifyOptions options;
  options.keep = {0.45, 0.2};
  options.grouping.grouping = lod::Grouping::compact;
  return lod::simplify(test::block(7, 7, 7, 0.01, test::material("firm", 2e7, 1000, 1e-4),
                                   voxelize::LatticeStyle::corners),
                       options);
}

/// Row p of a binding as the weights of all nodes.
std::vector<double> weights_of(const Binding& binding, std::uint32_t p, std::uint32_t node_count) {
  std::vector<double> weights(node_count, 0);
  for (std::uint32_t e = binding.start[p]; e < binding.start[p + 1]; ++e)
    weights[binding.node[e]] += binding.weight[e];
  return weights;
}

/// Compliance of a point of the whole body, balanced by inertia [m/N].
Mat3 compliance_of(const elastic::ElasticBody& body, const std::vector<double>& weights) {
  std::vector<elastic::StaticLoad> loads(3);
  for (int axis = 0; axis < 3; ++axis)
    for (const double weight : weights)
      loads[static_cast<std::size_t>(axis)].force.emplace_back(weight * Vec3::Unit(axis));
  const auto solutions = elastic::solve_static(body, loads, {.balance_free_motions = true});
  Mat3 compliance = Mat3::Zero();
  for (int axis = 0; axis < 3; ++axis)
    for (std::size_t i = 0; i < weights.size(); ++i)
      compliance.col(axis) +=
          weights[i] * solutions[static_cast<std::size_t>(axis)].displacement[i];
  return compliance;
}

/// A difference of compliances without the directions in which it is below 0: a contact cannot make
/// a body stiffer.
Mat3 softer_part(const Mat3& difference) {
  const Eigen::SelfAdjointEigenSolver<Mat3> axes(difference);
  return axes.eigenvectors() * axes.eigenvalues().cwiseMax(0).asDiagonal() *
         axes.eigenvectors().transpose();
}

/// Whether a node is on three faces of the box.
bool at_corner(const Box3& box, const Vec3& x) {
  for (int axis = 0; axis < 3; ++axis)
    if (std::min(x[axis] - box.min()[axis], box.max()[axis] - x[axis]) > 1e-9) return false;
  return true;
}

}  // namespace

TEST_CASE("A corner of a skin has the compliance that the base's corner has beyond the level's") {
  const LodChain chain = compact_levels();
  const MassSpringModel& base = chain.levels[0].model;
  const elastic::ElasticBody fine = elastic::elastic_body(base);
  const std::uint32_t level = GENERATE(1U, 2U);
  const MassSpringModel& model = chain.levels[level].model;
  const elastic::ElasticBody coarse = elastic::elastic_body(model);
  const ContactSkin skin = contact_skin(chain, level);
  int corners = 0;
  for (std::uint32_t p = 0; p < skin.base_node.size(); ++p) {
    const std::uint32_t node = skin.base_node[p];
    if (!at_corner(bounds(base.rest), base.rest[node])) continue;
    std::vector<double> at_node(base.node_count(), 0);
    at_node[node] = 1;
    const Mat3 wanted = compliance_of(fine, at_node);
    const Mat3 bare = compliance_of(coarse, weights_of(skin.of_nodes, p, model.node_count()));
    CAPTURE(level, node);
    ++corners;
    CHECK((skin.compliance[p] - softer_part(wanted - bare)).norm() < 0.2 * wanted.norm());
    CHECK((bare - wanted).norm() > 0.3 * wanted.norm());
    // Softer across the diagonal of the body than along it.
    const Vec3 diagonal = (base.rest[node] - bounds(base.rest).center()).normalized();
    const double along = diagonal.dot(skin.compliance[p] * diagonal);
    CHECK((skin.compliance[p].trace() - along) / 2 > 1.5 * along);
  }
  CHECK(corners == 8);
}

TEST_CASE("Lost compliances are symmetric, and those of a skin are positive semidefinite") {
  const LodChain chain = compact_levels();
  for (const std::uint32_t level : {1U, 2U})
    for (const Mat3& compliance : contact_skin(chain, level).compliance) {
      CHECK((compliance - compliance.transpose()).norm() <= 1e-12 * compliance.norm());
      CHECK(Eigen::SelfAdjointEigenSolver<Mat3>(compliance).eigenvalues()[0] >= 0);
    }
}

TEST_CASE("The compliance of a skin turns with the body") {
  const LodChain chain = compact_levels();
  const MassSpringModel& model = chain.levels[1].model;
  const ContactPoints points(model, contact_skin(chain, 1));
  const Mat3 rotation = Eigen::AngleAxisd(1.1, Vec3(1, -2, 0.5).normalized()).matrix();
  std::vector<Vec3> x;
  for (const Vec3& rest : model.rest) x.emplace_back(rotation * rest + Vec3(3, 4, 5));
  const Vec3 normal = Vec3(1, 2, 3).normalized();
  int turning = 0;
  for (std::uint32_t p = 0; p < points.count(); ++p) {
    const Mat3 frame = points.frame(p, [&](std::uint32_t node) { return x[node]; });
    const Mat3 at_rest = points.frame(p, [&](std::uint32_t node) { return model.rest[node]; });
    CHECK((at_rest - Mat3::Identity()).norm() < 1e-9);
    const auto wanted = points.yielding(p, normal, Mat3::Identity());
    const auto found = points.yielding(p, rotation * normal, points.turns(p) ? frame : rotation);
    CHECK(found.normal == Approx(wanted.normal));
    CHECK(found.tangential == Approx(wanted.tangential));
    CHECK((found.sideways - rotation * wanted.sideways).norm() <= 1e-9 * wanted.normal);
    if (points.turns(p)) {
      ++turning;
      CHECK((frame - rotation).norm() < 1e-9);
    }
  }
  CHECK(turning > static_cast<int>(points.count()) / 2);
}

TEST_CASE(
    "An isotropic compliance is one spring in series with the contact and one along the face") {
  const LodChain chain = compact_levels();
  const MassSpringModel& model = chain.levels[1].model;
  ContactSkin skin = contact_skin(chain, 1);
  const double compliance = 3e-6;
  for (Mat3& each : skin.compliance) each = compliance * Mat3::Identity();
  const ContactPoints points(model, skin);
  const std::vector<Obstacle> obstacles{test::floor(1e8, 0.5)};
  const ContactFinder finder(points, obstacles, model.rest);
  for (std::uint32_t p = 0; p < points.count(); ++p) {
    const Contact contact = finder.contact(0, p, Vec3::UnitZ(), Mat3::Identity());
    CHECK(contact.stiffness == Approx(1 / (1 / (1e8 * points.area(p)) + compliance)));
    CHECK(contact.stick_stiffness == Approx(1 / compliance));
    CHECK(contact.sideways.norm() < 1e-12 * compliance);
  }
}

TEST_CASE("The normal force of the last step moves the anchor of the stick spring") {
  Contact before;
  before.normal_force = 20;
  before.yield = {1e-4, 0, 0};
  before.stretch = {5e-4, 1e-4, 0};
  Contact now;
  now.friction = 0.5;
  now.sideways = {1e-5, 2e-5, 0};
  now.continue_from(before);
  CHECK((now.yield - Vec3(2e-4, 4e-4, 0)).norm() < 1e-12);
  CHECK((now.stretch - Vec3(6e-4, 5e-4, 0)).norm() < 1e-12);
  now.friction = 0;  // nothing holds the point
  now.continue_from(before);
  CHECK(now.stretch == before.stretch);
}

TEST_CASE("A level that lands on its corner and slides keeps its energy account closed", "[long]") {
  const LodChain chain = compact_levels();
  const std::uint32_t level = GENERATE(1U, 2U);
  const auto integrator = GENERATE(Integrator::symplectic_euler, Integrator::velocity_verlet);
  Scenario scene;
  scene.obstacles = {test::floor(1, 0.5)};
  scene.obstacles[0].stiffness.reset();
  scene.start.placed = true;
  scene.start.position = {0, 0, 0.065};
  scene.start.rotation =
      Eigen::Quaterniond::FromTwoVectors(Vec3(1, 1, 1).normalized(), Vec3(0.2, 0.1, 1).normalized())
          .toRotationMatrix();
  scene.start.velocity = {1, 0, -2};
  scene.start.spin = {3, 5, -4};
  scene.duration = 0.15;
  RunOptions options{.integrator = integrator,
                     .skin = std::make_shared<ContactSkin>(contact_skin(chain, level))};
  const Trajectory t = run(chain.levels[level].model, scene, options);
  REQUIRE(t.first_contact.has_value());
  const double start = t.ledger.front().kinetic;
  CAPTURE(level, to_string(integrator), t.ledger.back().lost_contact, start);
  CHECK(closure_error(t.ledger) < 0.01);
  // Friction and damping share the loss of a step by its length, to first order: at the default
  // step friction may have less than nothing.
  options.step = t.step / 4;
  CHECK(run(chain.levels[level].model, scene, options).ledger.back().lost_friction > 0.02 * start);
  // What the contact gains where the surface turns and yields along the face is small.
  for (const LedgerEntry& entry : t.ledger) CHECK(entry.lost_contact > -0.01 * start);
}
