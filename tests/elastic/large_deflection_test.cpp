#include "elastic/large_deflection.hpp"

#include <cmath>
#include <numbers>
#include <random>

#include <Eigen/Geometry>
#include <catch2/catch.hpp>

#include "base/error.hpp"
#include "elastic/loads.hpp"
#include "elastic/stiffness.hpp"
#include "elastic/tangent.hpp"
#include "tests/elastic/elastic_samples.hpp"
#include "tests/support/models.hpp"

using namespace springlod;
using namespace springlod::elastic;
using Catch::Contains;
using Nodes = std::vector<std::uint32_t>;

namespace {

/// A `corners` lattice of cells of 0.1 m, E = 1 MPa.
MassSpringModel soft_block(int nx, int ny, int nz, double poisson) {
  constexpr double kCell = 0.1;
  constexpr double kYoung = 1e6;
  const double shear = kYoung / (2 * (1 + poisson));
  const double bulk = kYoung / (3 * (1 - 2 * poisson));
  MassSpringModel model = test::corners_box(nx, ny, nz, kCell, 2.5 * shear, 1000);
  if (poisson == kSpringPoisson) return model;
  const double modulus = (bulk - 5 * shear / 3) * kCell * kCell * kCell;
  std::vector<std::uint32_t> nodes(8);
  std::vector<Vec3> gradients(8);
  for (int z = 0; z < nz; ++z)
    for (int y = 0; y < ny; ++y)
      for (int x = 0; x < nx; ++x) {
        for (unsigned c = 0; c < 8; ++c) {
          const int right = c & 1U, back = c >> 1U & 1U, up = c >> 2U;
          nodes[c] =
              static_cast<std::uint32_t>(((z + up) * (ny + 1) + y + back) * (nx + 1) + x + right);
          gradients[c] = Vec3(2 * right - 1, 2 * back - 1, 2 * up - 1) / (4 * kCell);
        }
        model.dilatation.add(modulus, 0, nodes, gradients);
      }
  validate(model);
  return model;
}

std::vector<std::uint32_t> nodes_at(const MassSpringModel& model, double x) {
  std::vector<std::uint32_t> nodes;
  for (std::uint32_t i = 0; i < model.node_count(); ++i)
    if (std::abs(model.rest[i].x() - x) < 1e-9) nodes.push_back(i);
  return nodes;
}

std::vector<Vec3> shaken(const MassSpringModel& model, double size) {
  std::mt19937_64 random(3);
  std::vector<Vec3> x = model.rest;
  for (Vec3& each : x)
    for (double& coordinate : each) coordinate += size * (2 * test::uniform(random) - 1);
  return x;
}

/// A force along z on the nodes of the face at the upper end along x, in equal shares.
std::vector<Vec3> end_load(const MassSpringModel& model, double force) {
  const std::vector<std::uint32_t> face = nodes_at(model, bounds(model.rest).max().x());
  std::vector<Vec3> load(model.node_count(), Vec3::Zero());
  for (const std::uint32_t i : face)
    load[i] = force / static_cast<double>(face.size()) * Vec3::UnitZ();
  return load;
}

double mean_z(const std::vector<Vec3>& displacement, const std::vector<std::uint32_t>& nodes) {
  double sum = 0;
  for (const std::uint32_t i : nodes) sum += displacement[i].z();
  return sum / static_cast<double>(nodes.size());
}

}  // namespace

TEST_CASE("Forces and tangents are the derivatives of the energy, with any Poisson's ratio") {
  const double poisson = GENERATE(0.1, 0.25, 0.45);
  const MassSpringModel model = soft_block(2, 2, 2, poisson);
  const std::vector<Vec3> x = shaken(model, 0.02);  // cells of 0.1 m
  const std::vector<Vec3> force = holding_forces(model, x);
  const Eigen::SparseMatrix<double> tangent = tangent_matrix(model, x, Tangent::exact);
  CHECK((tangent - Eigen::SparseMatrix<double>(tangent.transpose())).norm() <
        1e-12 * tangent.norm());
  constexpr double kSmall = 1e-6;  // [m]
  for (const std::uint32_t i : {0U, 7U, 13U, 26U})
    for (int axis = 0; axis < 3; ++axis) {
      std::vector<Vec3> more = x;
      std::vector<Vec3> less = x;
      more[i][axis] += kSmall;
      less[i][axis] -= kSmall;
      const double slope = (strain_energy(model, more) - strain_energy(model, less)) / (2 * kSmall);
      CHECK(force[i][axis] == Approx(slope).margin(1e-6 * 1e5));
      const std::vector<Vec3> up = holding_forces(model, more);
      const std::vector<Vec3> down = holding_forces(model, less);
      const Eigen::VectorXd column = tangent.col(3 * static_cast<int>(i) + axis);
      for (std::uint32_t j = 0; j < model.node_count(); ++j)
        CHECK((column.segment<3>(3 * j) - (up[j] - down[j]) / (2 * kSmall)).norm() <
              1e-6 * column.norm());
    }
}

TEST_CASE("The tangent at rest is the stiffness matrix") {
  const MassSpringModel model = soft_block(3, 2, 2, GENERATE(0.1, 0.25, 0.49));
  const Eigen::SparseMatrix<double> wanted = stiffness_matrix(model);
  for (const Tangent kind : {Tangent::exact, Tangent::convex})
    CHECK((tangent_matrix(model, model.rest, kind) - wanted).norm() < 1e-9 * wanted.norm());
}

TEST_CASE("Under a small load, a large deflection is the linear one") {
  const MassSpringModel model = soft_block(6, 2, 2, 0.45);
  const std::vector<std::uint32_t> clamp = nodes_at(model, bounds(model.rest).min().x());
  const std::vector<Vec3> force = end_load(model, 0.02);
  const LargeSolution large = deflect_far(model, {.force = force, .anchored = clamp});
  const StaticSolution linear =
      solve_static(elastic_body(model, {.anchored = clamp}), {{"end", force}}).front();
  double most = 0;
  double wrong = 0;
  for (std::uint32_t i = 0; i < model.node_count(); ++i) {
    most = std::max(most, linear.displacement[i].norm());
    wrong = std::max(wrong, (large.displacement[i] - linear.displacement[i]).norm());
  }
  CHECK(wrong < 1e-4 * most);
  CHECK(large.load_steps == 1);
  CHECK(large.residual <= 1e-9);
  CHECK(2 * large.energy == Approx(linear.compliance).epsilon(1e-4));
}

TEST_CASE("A cantilever bends as the elastica") {
  // P L^2 / E I = 5: the tip moves by 0.71379 L across and 0.38763 L back (Bisshopp and Drucker
  // 1945). At four cells across, the shortening, which goes with the square of the deflection, has
  // more than twice its error; `springlod validate` has finer bars.
  const double young = 1e6;
  const double side = 0.4;
  const MassSpringModel model = soft_block(80, 4, 4, 0.25);
  const double length = 8;
  const double moment = std::pow(side, 4) / 12;
  const std::vector<std::uint32_t> clamp = nodes_at(model, bounds(model.rest).min().x());
  const std::vector<std::uint32_t> tip = nodes_at(model, bounds(model.rest).max().x());
  const double force = 5 * young * moment / (length * length);
  const std::vector<Vec3> load = end_load(model, force);
  const LargeSolution found = deflect_far(model, {.force = load, .anchored = clamp});
  CHECK(mean_z(found.displacement, tip) / length == Approx(0.71379).epsilon(0.015));
  double back = 0;
  for (const std::uint32_t i : tip) back -= found.displacement[i].x() / double(tip.size());
  CHECK(back / length == Approx(0.38763).epsilon(0.05));
  // The clamp carries the force, and the torque of the tip where it has moved to.
  Vec3 sum = Vec3::Zero();
  Vec3 torque = Vec3::Zero();
  for (std::uint32_t i = 0; i < model.node_count(); ++i) {
    const Vec3 at = model.rest[i] + found.displacement[i];
    sum += load[i] + found.reaction[i];
    torque += at.cross(load[i] + found.reaction[i]);
  }
  CHECK(sum.norm() < 1e-6 * force);
  CHECK(torque.norm() < 1e-6 * force * length);
}

TEST_CASE("The work of anchors that turn an end of a bar is its energy") {
  const MassSpringModel model = soft_block(8, 2, 2, GENERATE(0.0, 0.45));
  const Box3 box = bounds(model.rest);
  const std::vector<std::uint32_t> low = nodes_at(model, box.min().x());
  const std::vector<std::uint32_t> high = nodes_at(model, box.max().x());
  std::vector<std::uint32_t> anchored = low;
  anchored.insert(anchored.end(), high.begin(), high.end());
  const Vec3 center = box.center();
  const auto turned = [&](double angle) {
    LargeLoad load{.force = std::vector<Vec3>(model.node_count(), Vec3::Zero()),
                   .anchored = anchored};
    load.hold = [&, angle](double part, std::vector<Vec3>& x) {
      const Mat3 turn = Eigen::AngleAxisd(part * angle, Vec3::UnitX()).toRotationMatrix();
      for (const std::uint32_t i : high) x[i] = center + turn * (model.rest[i] - center);
    };
    return deflect_far(model, load);
  };
  const double angle = 2;  // [rad]
  constexpr double kSmall = 1e-3;
  const LargeSolution found = turned(angle);
  double torque = 0;
  for (const std::uint32_t i : high)
    torque += (model.rest[i] + found.displacement[i] - center).cross(found.reaction[i]).x();
  CHECK(torque > 0);
  CHECK((turned(angle + kSmall).energy - turned(angle - kSmall).energy) / (2 * kSmall) ==
        Approx(torque).epsilon(1e-5));
}

TEST_CASE("Three legs snap through under more than they carry") {
  // Legs from a circle of radius 1 m to an apex 0.2 m above; force and height obey one equation.
  const double kThird = 2 * std::numbers::pi / 3;
  std::vector<Vec3> rest{{0, 0, 0.2}};
  for (int leg = 0; leg < 3; ++leg)
    rest.emplace_back(std::cos(kThird * leg), std::sin(kThird * leg), 0);
  const double k = 100;
  const MassSpringModel model =
      test::table_model(rest, {1, 1, 1, 1}, {{0, 1, k}, {0, 2, k}, {0, 3, k}});
  const double leg = std::sqrt(1.04);
  const auto carried = [&](double height) {  // downwards at the apex, by symmetry of height
    const double length = std::sqrt(1 + height * height);
    return 3 * k * (leg - length) * height / length;
  };
  std::vector<Vec3> force(4, Vec3::Zero());
  const LargeLoad held{.force = force, .anchored = Nodes{1, 2, 3}};
  for (const double height : {0.19, 0.17, -0.25, -0.3}) {  // the last two beyond the limit point
    LargeLoad load = held;
    load.force[0] = {0, 0, -carried(height)};
    if (height < 0) {
      REQUIRE(carried(height) > carried(0.115));  // the limit is near there
    }
    const LargeSolution found = deflect_far(model, load);
    CHECK(0.2 + found.displacement[0].z() == Approx(height).margin(1e-6));
    CHECK(found.residual <= 1e-9);
  }
}

TEST_CASE("A body on springs of its support follows them to any place, and balances their forces") {
  const MassSpringModel model = soft_block(6, 2, 2, 0.45);
  const Nodes left = nodes_at(model, 0);
  const Nodes right = nodes_at(model, bounds(model.rest).max().x());
  LargeLoad load{.force = end_load(model, 20), .anchored = left};
  for (const std::uint32_t i : right) load.anchored.springs.push_back({i, 3000});
  const Mat3 turn = Eigen::AngleAxisd(1.2, Vec3::UnitY()).toRotationMatrix();
  load.hold = [&](double part, std::vector<Vec3>& places) {
    const Mat3 now = Eigen::AngleAxisd(1.2 * part, Vec3::UnitY()).toRotationMatrix();
    for (const std::uint32_t i : right) places[i] = now * model.rest[i];
  };
  const LargeSolution found = deflect_far(model, load);
  CHECK(found.residual <= 1e-9);
  Vec3 sum = Vec3::Zero();
  for (const Vec3& force : load.force) sum += force;
  for (const Vec3& reaction : found.reaction) sum += reaction;
  CHECK(sum.norm() < 1e-6);
  double stored = 0;
  std::vector<Vec3> x = model.rest;
  for (std::uint32_t i = 0; i < model.node_count(); ++i) x[i] += found.displacement[i];
  for (const std::uint32_t i : right) {
    const Vec3 stretch = x[i] - turn * model.rest[i];
    CHECK((found.reaction[i] + 3000 * stretch).norm() < 1e-9);
    stored += 0.5 * 3000 * stretch.squaredNorm();
  }
  CHECK(stored > 0);
  CHECK(found.energy == Approx(strain_energy(model, x) + stored).epsilon(1e-12));

  // Of small forces it is the small solution.
  LargeLoad small{.force = end_load(model, 1e-4), .anchored = load.anchored};
  const LargeSolution bent = deflect_far(model, small);
  const StaticSolution linear =
      solve_static(elastic_body(model, {.anchored = load.anchored}), {{"end", small.force}}).at(0);
  for (std::uint32_t i = 0; i < model.node_count(); ++i)
    CHECK((bent.displacement[i] - linear.displacement[i]).norm() < 1e-11);
}

TEST_CASE("Bodies that are not held, and loads that are none, are refused") {
  const MassSpringModel model = soft_block(2, 2, 2, 0.25);
  const std::vector<Vec3> force(model.node_count(), Vec3::Zero());
  CHECK_THROWS_WITH(deflect_far(model, {.force = force, .anchored = Nodes{}}),
                    Contains("leave 6 motions of the component at node 1 free"));
  CHECK_THROWS_WITH(deflect_far(model, {.force = force, .anchored = Nodes{0, 1}}),
                    Contains("anchor more nodes"));
  CHECK_THROWS_WITH(deflect_far(model, {.force = {}, .anchored = Nodes{0}}),
                    Contains("0 forces for 27 nodes"));
  std::vector<Vec3> bad = force;
  bad[3].x() = NAN;
  CHECK_THROWS_WITH(deflect_far(model, {.force = bad, .anchored = Nodes{0}}),
                    Contains("the force on node 4 is not finite"));
}
