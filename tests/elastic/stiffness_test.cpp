#include "elastic/stiffness.hpp"

#include <cmath>

#include <catch2/catch.hpp>

#include "base/error.hpp"
#include "elastic/moduli.hpp"
#include "tests/support/dilatation.hpp"
#include "tests/support/lattices.hpp"

namespace springlod::elastic {
namespace {

using test::box_lattice;

std::vector<Vec3> some_displacements(std::uint32_t n) {
  std::vector<Vec3> u;
  for (std::uint32_t i = 0; i < n; ++i)
    u.emplace_back(std::sin(1.7 * i), std::cos(2.3 * i), std::sin(0.9 * i + 1));
  return u;
}

/// Elastic energy of the model at displacement h u, from spring lengths.
double energy(const MassSpringModel& m, const std::vector<Vec3>& u, double h) {
  double sum = 0;
  for (std::uint32_t s = 0; s < m.spring_count(); ++s) {
    const Vec3 end_a = m.rest[m.a[s]] + h * u[m.a[s]];
    const Vec3 end_b = m.rest[m.b[s]] + h * u[m.b[s]];
    const double stretch = (end_b - end_a).norm() - m.rest_length[s];
    sum += m.stiffness[s] * stretch * stretch / 2;
  }
  return sum;
}

TEST_CASE("The stiffness matrix is the second derivative of the elastic energy") {
  MassSpringModel m = box_lattice(3, 3, 2, 0.5, 7);
  for (std::uint32_t s = 0; s < m.spring_count(); ++s) m.stiffness[s] = 3 + std::sin(s);
  const auto u = some_displacements(m.node_count());
  std::vector<Vec3> f;
  apply_stiffness(m, u, f);
  double twice_energy = 0;
  for (std::uint32_t i = 0; i < m.node_count(); ++i) twice_energy += u[i].dot(f[i]);
  const double h = 1e-4;
  CHECK(twice_energy == Approx((energy(m, u, h) + energy(m, u, -h)) / (h * h)).epsilon(1e-5));
}

TEST_CASE("Dilatation terms are in the assembled matrix, which is the derivative of their energy") {
  const MassSpringModel m =
      GENERATE(test::lattice_with_terms(3, 3, 2), test::random_model_with_terms(5, 3));
  const auto u = some_displacements(m.node_count());
  std::vector<Vec3> f;
  apply_stiffness(m, u, f);
  Eigen::VectorXd flat(3 * m.node_count());
  for (std::uint32_t i = 0; i < m.node_count(); ++i) flat.segment<3>(3 * i) = u[i];
  const Eigen::MatrixXd k(stiffness_matrix(m));
  const Eigen::VectorXd product = k * flat;
  double twice_energy = 0;
  for (std::uint32_t i = 0; i < m.node_count(); ++i) {
    CHECK((product.segment<3>(3 * i) - f[i]).norm() < 1e-12 * product.norm());
    twice_energy += u[i].dot(f[i]);
  }
  CHECK((k - k.transpose()).norm() < 1e-14 * k.norm());
  MassSpringModel springs = m;
  springs.dilatation = {};
  apply_stiffness(springs, u, f);
  double springs_alone = 0;
  for (std::uint32_t i = 0; i < m.node_count(); ++i) springs_alone += u[i].dot(f[i]);
  const double h = 1e-4;
  const auto terms_at = [&](double scale) {
    std::vector<Vec3> x = m.rest;
    for (std::uint32_t i = 0; i < m.node_count(); ++i) x[i] += scale * u[i];
    return dilatation_energy(m.dilatation, x);
  };
  CHECK(twice_energy - springs_alone ==
        Approx((terms_at(h) + terms_at(-h)) / (h * h)).epsilon(1e-4));
}

TEST_CASE("The assembled matrix is symmetric and agrees with apply_stiffness") {
  MassSpringModel m = box_lattice(3, 4, 2);
  for (std::uint32_t s = 0; s < m.spring_count(); ++s) m.stiffness[s] = 3 + std::cos(s);
  const auto u = some_displacements(m.node_count());
  std::vector<Vec3> f;
  apply_stiffness(m, u, f);
  Eigen::VectorXd flat(3 * m.node_count());
  for (std::uint32_t i = 0; i < m.node_count(); ++i) flat.segment<3>(3 * i) = u[i];
  const auto k = stiffness_matrix(m);
  const Eigen::VectorXd product = k * flat;
  for (std::uint32_t i = 0; i < m.node_count(); ++i)
    CHECK((product.segment<3>(3 * i) - f[i]).norm() < 1e-12);
  CHECK((Eigen::MatrixXd(k) - Eigen::MatrixXd(k).transpose()).norm() == 0);
  CHECK_THROWS_AS(apply_stiffness(m, {}, f), InputError);
}

TEST_CASE("Rigid motions cause no force") {
  const MassSpringModel m = box_lattice(3, 3, 3);
  std::vector<Vec3> u, f;
  for (const Vec3& x : m.rest) u.emplace_back(Vec3(1, 2, 3) + Vec3(0.3, -0.2, 0.5).cross(x));
  apply_stiffness(m, u, f);
  for (const Vec3& force : f) CHECK(force.norm() < 1e-13);
}

TEST_CASE("A stretched row of springs has the stiffness of springs in series") {
  const MassSpringModel m = test::chain_of_nodes(6, 10);  // 5 springs of 10 N/m, 1 m each
  const StretchResult r = stretch_test(m, {.axis = 0, .cross_section = 2});
  CHECK(r.reaction == Approx(10).epsilon(1e-9));  // 2 N/m over 5 m
  CHECK(r.young == Approx(5).epsilon(1e-9));
  CHECK(r.strain_energy == Approx(25).epsilon(1e-9));
  CHECK(std::isnan(r.poisson));
}

TEST_CASE("Segments in series have strains inverse to their stiffness") {
  MassSpringModel m = test::chain_of_nodes(9, 10);
  for (std::uint32_t s = 4; s < 8; ++s) m.stiffness[s] = 1000;
  const double compliance = 4.0 / 10 + 4.0 / 1000;
  CHECK(stretch_test(m, {.axis = 0, .cross_section = 1}).reaction ==
        Approx(8 / compliance).epsilon(1e-9));
}

TEST_CASE("A loose node or a mechanism does not change the stretch test") {
  MassSpringModel m = box_lattice(4, 4, 8);
  const StretchResult sound = stretch_test(m, {.cross_section = 9});
  m.rest.emplace_back(9, 9, 3);
  m.mass.push_back(1);
  m.volume.push_back(1);
  m.contact_area.push_back(0);
  m.border.push_back(1);
  m.material.push_back(0);
  const StretchResult loose = stretch_test(m, {.cross_section = 9});
  CHECK(loose.young == Approx(sound.young).epsilon(1e-7));
}

TEST_CASE("A model that cannot be stretched is rejected") {
  CHECK_THROWS_AS(stretch_test(box_lattice(3, 3, 1)), InputError);
  CHECK_THROWS_AS(stretch_test(test::make_model({{0, 0, 0}, {0, 0, 1}}, {})), InputError);
  CHECK_THROWS_AS(stretch_test(box_lattice(3, 3, 3), {.axis = 3}), InputError);
}

}  // namespace
}  // namespace springlod::elastic
