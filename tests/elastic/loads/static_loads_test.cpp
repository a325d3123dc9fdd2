#include <cmath>
#include <random>

#include <catch2/catch.hpp>

#include "base/error.hpp"
#include "elastic/loads.hpp"
#include "elastic/modes.hpp"
#include "tests/elastic/elastic_samples.hpp"
#include "tests/support/models.hpp"

namespace springlod::elastic {
namespace {

/// Forces of a uniform stress on the surface of a box of cells of edge a: each corner of an outer
/// face has a quarter of stress times area.
StaticLoad surface_load(const MassSpringModel& m, double a, const Mat3& stress) {
  const Box3 box = bounds(m.rest);
  StaticLoad load{"surface", {}};
  for (const Vec3& p : m.rest) {
    Vec3 area = Vec3::Zero();
    for (int d = 0; d < 3; ++d) {
      const auto at_end = [&](int e) {
        return p[e] < box.min()[e] + a / 2 || p[e] > box.max()[e] - a / 2;
      };
      if (!at_end(d)) continue;
      double share = a * a;
      for (int e = 0; e < 3; ++e)
        if (e != d && at_end(e)) share /= 2;
      area[d] = p[d] > box.center()[d] ? share : -share;
    }
    load.force.emplace_back(stress * area);
  }
  return load;
}

TEST_CASE("Patch test: uniform stress on a corners bar gives the strain of its material") {
  const double young = 3e6, nu = 0.25, a = 0.01;
  const MassSpringModel bar = test::corners_box(4, 3, 12, a, young, 1000);
  const double volume = 4 * 3 * 12 * a * a * a;
  Mat3 stretch = Mat3::Zero(), shear = Mat3::Zero(), mixed;
  stretch(2, 2) = 100;
  shear(0, 2) = shear(2, 0) = 100;
  mixed << 3, 1, -2, 1, -5, 4, -2, 4, 2;
  const ElasticBody body = elastic_body(bar);
  for (const Mat3& stress : {stretch, shear, mixed}) {
    const StaticLoad load = surface_load(bar, a, stress);
    const StaticSolution solution = solve_static(body, {load}).at(0);
    const Mat3 strain = ((1 + nu) * stress - nu * stress.trace() * Mat3::Identity()) / young;
    CHECK(solution.compliance == Approx(volume * stress.cwiseProduct(strain).sum()).epsilon(1e-10));
    // The displacement is the uniform strain plus a rigid motion.
    const ElasticComponent& component = body.components.at(0);
    std::vector<Vec3> strained;
    for (const Vec3& p : bar.rest) strained.emplace_back(strain * p);
    Eigen::MatrixXd expected = component.gather(strained).cwiseProduct(component.root_mass);
    component.remove_zero_modes(expected);
    const Eigen::VectorXd found =
        test::flatten(solution.displacement).cwiseProduct(component.root_mass);
    CHECK((found - expected).norm() < 1e-10 * expected.norm());
    CHECK(solution.residual < 1e-9);
  }
}

/// Work of unit moments that bend a bar with a cross-section of one cell and a length of `cells`.
StaticSolution bend_by_moments(int cells) {
  const double a = 0.01;
  const MassSpringModel bar = test::corners_box(1, 1, cells, a, 1e7, 1000);
  StaticLoad load{"moments", std::vector<Vec3>(bar.node_count(), Vec3::Zero())};
  for (std::uint32_t i = 0; i < bar.node_count(); ++i) {
    const double side = bar.rest[i].x() > a / 2 ? 1 : -1;
    if (bar.rest[i].z() < a / 2) load.force[i].z() = -side;
    if (bar.rest[i].z() > (cells - 0.5) * a) load.force[i].z() = side;
  }
  return solve_static(elastic_body(bar), {load}).at(0);
}

TEST_CASE("The compliance of a bar a thousand times as long as thick is the sum over its cells") {
  // Its lowest bending eigenvalues are about as small as the shift of the factors, which alone
  // would make it too stiff.
  const StaticSolution bar = bend_by_moments(1000);
  CHECK(bar.residual < 1e-12);
  // Under a constant moment the contribution of each cell is the same, and that of the ends does
  // not depend on the length.
  const double end = bend_by_moments(20).compliance;
  const double cell = (bend_by_moments(40).compliance - end) / 20;
  // The entries of the matrix have a relative rounding error of 1e-16, and they are about 1e12
  // times the bending stiffnesses.
  CHECK(bar.compliance == Approx(end + 980 * cell).epsilon(1e-3));
}

std::vector<StaticLoad> random_loads(std::uint32_t nodes, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  std::vector<StaticLoad> loads(3);
  for (StaticLoad& load : loads)
    for (std::uint32_t i = 0; i < nodes; ++i)
      load.force.emplace_back(test::uniform(random), test::uniform(random), test::uniform(random));
  return loads;
}

TEST_CASE("Displacements are those of the pseudo-inverse of a dense solver") {
  const MassSpringModel one = test::random_model(1, 5);
  const MassSpringModel m = test::side_by_side(one, test::random_model(2, 4), {20, 0, 0});
  const std::vector<StaticLoad> loads = random_loads(m.node_count(), 3);
  const std::vector<StaticSolution> solutions = solve_static(elastic_body(m), loads);
  const auto dense = test::dense_spectrum(m);
  Eigen::VectorXd inverse = Eigen::VectorXd::Zero(dense.eigenvalues().size());
  for (Eigen::Index i = 12; i < inverse.size(); ++i) inverse[i] = 1 / dense.eigenvalues()[i];
  Eigen::VectorXd weight(inverse.size());
  for (Eigen::Index i = 0; i < weight.size(); ++i)
    weight[i] = 1 / std::sqrt(m.mass[static_cast<std::size_t>(i / 3)]);
  for (std::size_t l = 0; l < loads.size(); ++l) {
    const Eigen::VectorXd part =
        dense.eigenvectors().transpose() * weight.cwiseProduct(test::flatten(loads[l].force));
    const Eigen::VectorXd expected =
        weight.cwiseProduct(dense.eigenvectors() * inverse.cwiseProduct(part));
    CHECK((test::flatten(solutions[l].displacement) - expected).norm() < 1e-9 * expected.norm());
    CHECK(solutions[l].compliance == Approx(part.dot(inverse.cwiseProduct(part))).epsilon(1e-9));
    CHECK(solutions[l].residual < 1e-9);
  }
}

// Solved exactly in one step, after which there is only rounding to follow.
TEST_CASE("A spring between two nodes is strained by what the loads have along it alone") {
  std::mt19937_64 random(1);
  const auto number = [&] { return 2 * test::uniform(random) - 1; };
  const auto any = [&] {
    const double x = number(), y = number(), z = number();
    return Vec3(x, y, z);
  };
  for (int i = 0; i < 50; ++i) {
    const double k = std::pow(10, 6 + 3 * number());
    const Vec3 first = any();
    const Vec3 second = i % 2 == 0 ? any() : Vec3(first + number() * Vec3::Unit(i % 3));
    MassSpringModel m = test::make_model({first, second}, {{0, 1}}, k);
    m.mass[0] = 2 + number();
    m.mass[1] = i % 4 < 2 ? m.mass[0] : 2 + number();
    const Vec3 u = spring_direction(m, 0);
    std::vector<StaticLoad> loads;
    for (int l = 0; l < 4; ++l) loads.push_back({"any", {any(), any()}});
    loads.push_back({"across", {u.unitOrthogonal(), Vec3::Zero()}});
    const std::vector<StaticSolution> solved = solve_static(elastic_body(m), loads);
    for (std::size_t l = 0; l < loads.size(); ++l) {
      CAPTURE(i, l);
      // What accelerates both nodes equally is balanced by inertia.
      const double share = m.mass[1] / (m.mass[0] + m.mass[1]);
      const double along = loads[l].force[1].dot(u);
      const double back = loads[l].force[0].dot(u);
      const double tension = along * (1 - share) - back * share;
      const std::vector<Vec3>& x = solved[l].displacement;
      CHECK(u.dot(x[1] - x[0]) == Approx(tension / k).margin(1e-12 / k));
      CHECK(x[0].norm() + x[1].norm() < 2 / k);
      CHECK(solved[l].compliance == Approx(tension * tension / k).margin(1e-12 / k));
    }
  }
}

TEST_CASE("A load that only translates and rotates a free body does not strain it") {
  const MassSpringModel m = test::random_model(4, 5);
  StaticLoad load{"push", {}};
  const Vec3 center = mass_properties(m).center;
  for (std::uint32_t i = 0; i < m.node_count(); ++i)
    load.force.emplace_back(m.mass[i] *
                            (Vec3(1, 2, 3) + Vec3(-1, 0.5, 2).cross(m.rest[i] - center)));
  const StaticSolution solution = solve_static(elastic_body(m), {load}).at(0);
  for (const Vec3& u : solution.displacement) CHECK(u.norm() < 1e-9);
  CHECK(std::abs(solution.compliance) < 1e-12);
}

TEST_CASE("The compliance is twice the elastic energy and the sum over the modes") {
  const MassSpringModel m = test::random_model(5, 4);
  const ElasticBody body = elastic_body(m);
  const std::vector<StaticLoad> loads = smooth_loads(m);
  const std::vector<StaticSolution> solutions = solve_static(body, loads);
  const Modes all = lowest_modes(body, {.count = 1000});
  for (std::size_t l = 0; l < loads.size(); ++l) {
    std::vector<Vec3> force;
    apply_stiffness(m, solutions[l].displacement, force);
    const double energy = test::flatten(force).dot(test::flatten(solutions[l].displacement)) / 2;
    CHECK(solutions[l].compliance == Approx(2 * energy).epsilon(1e-9));
    double sum = 0;
    for (const Mode& mode : all.modes)
      sum += std::pow(
          test::flatten(mode.shape).dot(test::flatten(loads[l].force)) / mode.angular_frequency, 2);
    CHECK(solutions[l].compliance == Approx(sum).epsilon(1e-8));
  }
}

TEST_CASE("A row of springs has the compliance of springs in series") {
  const MassSpringModel m = test::chain_of_nodes(120, 10);  // mechanisms: all lateral motions
  StaticLoad load{"pull", std::vector<Vec3>(120, Vec3::Zero())};
  load.force.front() = {-2, 0, 0};
  load.force.back() = {2, 0, 0};
  const StaticSolution solution = solve_static(elastic_body(m), {load}).at(0);
  CHECK(solution.compliance == Approx(2 * 2 * 119.0 / 10).epsilon(1e-10));
  CHECK(solution.displacement.back().x() - solution.displacement.front().x() ==
        Approx(2 * 119.0 / 10).epsilon(1e-10));
}

TEST_CASE("Nine smooth loads, 1 N each, bend and twist the longest axis") {
  const MassSpringModel bar = test::corners_box(3, 9, 4, 0.1, 1e6, 1000);
  const std::vector<StaticLoad> loads = smooth_loads(bar);
  std::vector<std::string> names;
  for (const StaticLoad& load : loads) {
    names.push_back(load.name);
    double amount = 0;
    Vec3 sum = Vec3::Zero(), moment = Vec3::Zero();
    for (std::uint32_t i = 0; i < bar.node_count(); ++i) {
      amount += load.force[i].norm();
      sum += load.force[i];
      moment += (bar.rest[i] - mass_properties(bar).center).cross(load.force[i]);
    }
    CHECK(amount == Approx(1));
    CHECK(sum.norm() < 1e-12);
    // A shear rotates a body whose length and width differ; the other loads are in equilibrium.
    if (load.name.rfind("shear", 0) != 0) CHECK(moment.norm() < 1e-12);
  }
  CHECK(names == std::vector<std::string>{"stretch x", "stretch y", "stretch z", "shear yz",
                                          "shear xz", "shear xy", "bend y to x", "bend y to z",
                                          "twist y"});
  for (const StaticSolution& solution : solve_static(elastic_body(bar), loads))
    CHECK(solution.compliance > 0);
}

TEST_CASE("Scaling all stiffness scales all compliances") {
  MassSpringModel m = test::random_model(6, 5);
  const std::vector<StaticLoad> loads = smooth_loads(m);
  const auto soft = solve_static(elastic_body(m), loads);
  for (double& k : m.stiffness) k *= 4;
  const auto stiff = solve_static(elastic_body(m), loads);
  for (std::size_t l = 0; l < loads.size(); ++l)
    CHECK(soft[l].compliance == Approx(4 * stiff[l].compliance).epsilon(1e-10));
}

TEST_CASE("A load without a lever arm is zero") {
  const MassSpringModel row = test::chain_of_nodes(5);
  const std::vector<StaticLoad> loads = smooth_loads(row);
  REQUIRE(loads.size() == 9);
  const std::vector<StaticSolution> solutions = solve_static(elastic_body(row), loads);
  CHECK(solutions[0].compliance > 0);
  CHECK(solutions[1].compliance == 0);
  CHECK(solutions[1].residual == 0);
}

TEST_CASE("Loads of the wrong size or with values that are not finite are rejected") {
  const ElasticBody body = elastic_body(test::box_lattice(3, 3, 3));
  CHECK_THROWS_AS(solve_static(body, {{"short", {}}}), InputError);
  StaticLoad load{"odd", std::vector<Vec3>(27, Vec3::Zero())};
  load.force[3].x() = NAN;
  CHECK_THROWS_AS(solve_static(body, {load}), InputError);
  CHECK(solve_static(body, {}).empty());
}

}  // namespace
}  // namespace springlod::elastic
