#include "model/dilatation.hpp"

#include <cmath>
#include <numeric>

#include <Eigen/LU>
#include <catch2/catch.hpp>

#include "base/error.hpp"
#include "model/components.hpp"
#include "tests/support/dilatation.hpp"

using namespace springlod;
using namespace springlod::test;
using Catch::Matchers::Contains;

namespace {

double sum(const std::vector<double>& values) {
  return std::accumulate(values.begin(), values.end(), 0.0);
}

std::vector<Vec3> mapped(const std::vector<Vec3>& x, const Mat3& gradient) {
  std::vector<Vec3> moved;
  for (const Vec3& each : x) moved.emplace_back(gradient * each + Vec3(3, -1, 2));
  return moved;
}

}  // namespace

TEST_CASE("Springs and terms of a material have its shear and bulk modulus together") {
  const double nu = GENERATE(-0.2, 0., 0.25, 0.3, 0.45, 0.495);
  const Material of{.name = "any", .young = 3e5, .poisson = nu};
  const double shear = of.young / (2 * (1 + nu)), bulk = of.young / (3 * (1 - 2 * nu));
  CHECK(spring_young(of) / 2.5 == Approx(shear));
  CHECK(spring_young(of) / 1.5 + dilatation_modulus(of) == Approx(bulk));
  // Eq. 2: W / V = 6 E of the springs.
  CHECK(affine_young(6 * spring_young(of) * 2, dilatation_modulus(of) * 2, 2) == Approx(of.young));
  if (nu == kSpringPoisson) {
    CHECK(spring_young(of) == of.young);
    CHECK(dilatation_modulus(of) == 0);
  }
}

TEST_CASE("The slope of a dilatation is its derivative, and that of a negative term is bounded") {
  const double modulus = GENERATE(2., -2.);
  constexpr double h = 1e-6;
  for (const double ratio : {-0.5, 0., 0.4, 1., 1.3, 5.}) {
    const double change =
        dilatation(ratio + h, modulus).strain - dilatation(ratio - h, modulus).strain;
    CHECK(dilatation(ratio, modulus).slope == Approx(change / (2 * h)).epsilon(1e-6));
  }
  CHECK(dilatation(1, modulus).strain == 0);
  CHECK(dilatation(1, modulus).slope == 1);
  if (modulus < 0) CHECK(dilatation(1e3, modulus).strain < 1);
}

TEST_CASE("The volume ratio is the determinant of F, with its derivative") {
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    const std::vector<Vec3> columns = random_vectors(seed, 6, 1);
    Mat3 gradient = Mat3::Identity(), change;
    for (int c = 0; c < 3; ++c) {
      gradient.col(c) += 0.5 * columns[static_cast<std::size_t>(c)];
      change.col(c) = columns[static_cast<std::size_t>(c) + 3];
    }
    const VolumeRatio ratio = volume_ratio(gradient);
    CHECK(ratio.value == Approx(gradient.determinant()));
    constexpr double h = 1e-6;
    const double rate =
        ((gradient + h * change).determinant() - (gradient - h * change).determinant()) / (2 * h);
    CHECK(ratio.by_gradient.cwiseProduct(change).sum() == Approx(rate).epsilon(1e-6));
  }
}

TEST_CASE("The term of every node measures a uniform deformation exactly") {
  const MassSpringModel model =
      GENERATE(random_model_with_terms(1, 5), lattice_with_terms(4, 3, 5));
  Mat3 gradient;
  gradient << 1.1, 0.2, -0.1, 0.05, 0.9, 0.3, 0, -0.2, 1.2;
  const std::vector<Vec3> x = mapped(model.rest, gradient);
  std::vector<Vec3> u;
  for (const Vec3& each : model.rest) u.emplace_back(gradient * each);
  REQUIRE(model.dilatation.count() > 0);
  for (std::uint32_t t = 0; t < model.dilatation.count(); ++t) {
    CHECK((mean_gradient(model.dilatation, t, x) - gradient).norm() < 1e-12);
    CHECK(linear_dilatation(model.dilatation, t, u) == Approx(gradient.trace()));
  }
  CHECK(dilatation_energy(model.dilatation, model.rest) == Approx(0).margin(1e-20));
}

TEST_CASE("Nodes in a plane have no terms, nodes nearly in a plane reach further") {
  std::vector<Vec3> rest;
  std::vector<double> mass;
  std::vector<TableSpring> springs;
  const auto number = [](int x, int y, int z) {
    return static_cast<std::uint32_t>(9 * z + 3 * y + x);
  };
  for (int z = 0; z < 3; ++z)
    for (int y = 0; y < 3; ++y)
      for (int x = 0; x < 3; ++x) {
        rest.emplace_back(x, y, 0.2 * z);
        mass.push_back(1);
        if (x > 0) springs.push_back({number(x - 1, y, z), number(x, y, z), 1});
        if (y > 0) springs.push_back({number(x, y - 1, z), number(x, y, z), 1});
        if (z > 0) springs.push_back({number(x, y, z - 1), number(x, y, z), 1});
      }
  const MassSpringModel solid = table_model(rest, mass, springs);
  for (Vec3& each : rest) each.z() = each.z() * 1e-3;
  const MassSpringModel flat = table_model(rest, mass, springs);
  CHECK(node_terms(flat, std::vector<NodeDilatation>(27, {1, 0})).empty());
  MassSpringModel with_terms = solid;
  with_terms.dilatation = node_terms(solid, std::vector<NodeDilatation>(27, {1, 0}));
  validate(with_terms);
  for (const Vec3& gradient : with_terms.dilatation.gradient) CHECK(gradient.norm() < 3);
}

TEST_CASE("The shares of the nodes add up to the terms, equal ones in a cell") {
  const MassSpringModel cell = lattice_with_terms(2, 2, 2);
  const DilatationShares shares = dilatation_shares(cell);
  for (const double share : shares.modulus) CHECK(share == Approx(cell.dilatation.modulus[0] / 8));
  for (const double time : shares.damping_time) CHECK(time == Approx(0.1));
  const MassSpringModel model = random_model_with_terms(3);
  CHECK(sum(dilatation_shares(model).modulus) == Approx(sum(model.dilatation.modulus)));
}

TEST_CASE("Components keep their terms") {
  const MassSpringModel one = random_model_with_terms(4);
  MassSpringModel two = one;
  const std::uint32_t n = one.node_count();
  for (std::uint32_t i = 0; i < n; ++i) {
    two.rest.emplace_back(one.rest[i] + Vec3(100, 0, 0));
    two.mass.push_back(one.mass[i]);
    two.volume.push_back(one.volume[i]);
    two.contact_area.push_back(one.contact_area[i]);
    two.border.push_back(one.border[i]);
    two.material.push_back(one.material[i]);
  }
  for (std::uint32_t s = 0; s < one.spring_count(); ++s) {
    two.a.push_back(one.a[s] + n);
    two.b.push_back(one.b[s] + n);
    two.rest_length.push_back(one.rest_length[s]);
    two.stiffness.push_back(one.stiffness[s]);
    two.damping.push_back(one.damping[s]);
  }
  for (std::uint32_t t = 0; t < one.dilatation.count(); ++t) {
    std::vector<std::uint32_t> nodes(one.dilatation.nodes(t).begin(),
                                     one.dilatation.nodes(t).end());
    for (std::uint32_t& node : nodes) node += n;
    two.dilatation.add(one.dilatation.modulus[t], one.dilatation.damping_time[t], nodes,
                       one.dilatation.gradients(t));
  }
  validate(two);
  const auto parts = split_components(two, connected_components(two));
  REQUIRE(parts.size() == 2);
  for (const ModelComponent& part : parts) {
    validate(part.model);
    CHECK(part.model.dilatation.modulus == one.dilatation.modulus);
    CHECK(part.model.dilatation.node == one.dilatation.node);
  }
  CHECK(parts[1].terms.front() == one.dilatation.count());
}

TEST_CASE("A term that breaks a rule is named with the rule") {
  const MassSpringModel sound = lattice_with_terms(3, 2, 2);
  const auto refused = [&](const char* why, const auto& change) {
    MassSpringModel broken = sound;
    change(broken.dilatation);
    CHECK_THROWS_AS(validate(broken), InputError);
    CHECK_THROWS_WITH(validate(broken), Contains(why));
  };
  refused("term 2: its modulus", [](DilatationTerms& t) { t.modulus[1] = NAN; });
  refused("term 1: its modulus", [](DilatationTerms& t) { t.modulus[0] = 0; });
  refused("term 1: its damping time", [](DilatationTerms& t) { t.damping_time[0] = -1; });
  refused("does not exist", [](DilatationTerms& t) { t.node[7] = 12; });
  refused("sorted", [](DilatationTerms& t) { std::swap(t.node[0], t.node[1]); });
  refused("gradient", [](DilatationTerms& t) { t.gradient[3].x() = INFINITY; });
  refused("unit matrix", [](DilatationTerms& t) { t.gradient[3] *= 1.1; });
  refused("entries", [](DilatationTerms& t) { t.gradient.pop_back(); });
  refused("must follow", [](DilatationTerms& t) { t.start[1] = 17; });
  refused("come first", [](DilatationTerms& t) { t.start[0] = 1; });
  refused("entries", [](DilatationTerms& t) { t.start.pop_back(); });
}
