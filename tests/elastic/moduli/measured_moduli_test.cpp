#include <catch2/catch.hpp>

#include "base/error.hpp"
#include "elastic/moduli.hpp"
#include "tests/elastic/elastic_samples.hpp"
#include "tests/support/models.hpp"

namespace springlod::elastic {
namespace {

std::vector<MaterialModuli> under_smooth_loads(const MassSpringModel& model) {
  return measured_moduli(model, solve_static(elastic_body(model), smooth_loads(model)));
}

/// A solution with one displacement gradient for all nodes, not in equilibrium in general.
StaticSolution affine(const MassSpringModel& model, const Mat3& gradient) {
  StaticSolution solution;
  for (const Vec3& p : model.rest) solution.displacement.emplace_back(gradient * p);
  return solution;
}

/// A block of two materials: the half above z = `height` is `factor` times as stiff.
MassSpringModel two_halves(double height, double factor) {
  MassSpringModel m = test::corners_box(4, 4, 12, 0.1, 1e6, 1000);
  m.materials.push_back(Material{.name = "other"});
  for (std::uint32_t i = 0; i < m.node_count(); ++i)
    m.material[i] = m.rest[i].z() > height - 1e-6 ? 1 : 0;
  for (std::uint32_t s = 0; s < m.spring_count(); ++s) {
    const double middle = (m.rest[m.a[s]].z() + m.rest[m.b[s]].z()) / 2;
    // Springs within the interface belong to cells of both sides.
    if (std::abs(middle - height) < 1e-6) m.stiffness[s] *= (1 + factor) / 2;
    if (middle > height + 1e-6) m.stiffness[s] *= factor;
  }
  return m;
}

TEST_CASE("Smooth loads measure E and nu of corners blocks") {
  const auto [x, y, z] = GENERATE(table<int, int, int>({{10, 10, 10}, {4, 4, 12}, {2, 3, 2}}));
  const MassSpringModel block = test::corners_box(x, y, z, 0.1, 1e6, 1000);
  const std::vector<MaterialModuli> found = under_smooth_loads(block);
  REQUIRE(found.size() == 1);
  CHECK(found[0].material == 0);
  // The strain of these loads is uneven; its average is hardly affected.
  CHECK(found[0].young == Approx(1e6).epsilon(1e-3));
  CHECK(found[0].poisson == Approx(0.25).margin(1e-3));
  CHECK(found[0].volume == Approx(x * y * z * 1e-3));
}

TEST_CASE("Moduli scale with the stiffness of the springs and the volume of the nodes") {
  MassSpringModel block = test::corners_box(3, 4, 5, 0.1, 1e6, 1000);
  for (double& k : block.stiffness) k *= 3;
  for (double& v : block.volume) v *= 2;
  const std::vector<MaterialModuli> found = under_smooth_loads(block);
  REQUIRE(found.size() == 1);
  CHECK(found[0].young == Approx(1.5e6).epsilon(5e-3));
  CHECK(found[0].poisson == Approx(0.25).margin(5e-3));
}

TEST_CASE("All loads have the same weight, and rotations do not count") {
  // Springs along the edges are a tenth as stiff: the material is anisotropic, so loads measure
  // different moduli.
  MassSpringModel block = test::corners_box(3, 3, 3, 0.1, 1e6, 1000);
  for (std::uint32_t s = 0; s < block.spring_count(); ++s)
    if (block.rest_length[s] < 0.12) block.stiffness[s] /= 10;
  Mat3 stretch = Mat3::Zero(), shear = Mat3::Zero(), turn;
  stretch(0, 0) = 1;
  shear(1, 2) = 1;
  turn << 0, -1, 2, 1, 0, -3, -2, 3, 0;
  const std::vector<MaterialModuli> plain =
      measured_moduli(block, {affine(block, stretch), affine(block, shear)});
  const std::vector<MaterialModuli> scaled =
      measured_moduli(block, {affine(block, 1e-6 * stretch + turn), affine(block, 1e3 * shear)});
  REQUIRE(plain.size() == 1);
  REQUIRE(scaled.size() == 1);
  CHECK(scaled[0].young == Approx(plain[0].young).epsilon(1e-6));
  CHECK(scaled[0].poisson == Approx(plain[0].poisson).epsilon(1e-6));
}

TEST_CASE("The moduli of two materials are measured separately") {
  const std::vector<MaterialModuli> found = under_smooth_loads(two_halves(0.6, 10));
  REQUIRE(found.size() == 2);
  CHECK(found[0].material == 0);
  CHECK(found[1].material == 1);
  CHECK(found[0].young == Approx(1e6).epsilon(0.01));
  // The nodes of the interface belong to this half (a fourteenth of its volume) but have soft cells
  // on one side.
  CHECK(found[1].young == Approx(1e7).epsilon(0.08));
  for (const MaterialModuli& each : found) CHECK(each.poisson == Approx(0.25).margin(0.01));
  CHECK(found[0].volume + found[1].volume == Approx(4 * 4 * 12 * 1e-3));
}

TEST_CASE("Relative motion of two regions of one material is not strain") {
  // Two stiff ends; the middle third is a thousand times softer and therefore strained far more.
  MassSpringModel bar = test::corners_box(4, 4, 18, 0.1, 1e6, 1000);
  bar.materials.push_back(Material{.name = "soft"});
  for (std::uint32_t i = 0; i < bar.node_count(); ++i)
    bar.material[i] = bar.rest[i].z() > 0.65 && bar.rest[i].z() < 1.15 ? 1 : 0;
  for (std::uint32_t s = 0; s < bar.spring_count(); ++s) {
    const double middle = (bar.rest[bar.a[s]].z() + bar.rest[bar.b[s]].z()) / 2;
    if (middle > 0.61 && middle < 1.19) bar.stiffness[s] /= 1000;
  }
  const std::vector<MaterialModuli> found = under_smooth_loads(bar);
  REQUIRE(found.size() == 2);
  CHECK(found[0].young == Approx(1e6).epsilon(0.02));
  CHECK(found[0].poisson == Approx(0.25).margin(0.01));
}

TEST_CASE("A node at the tip of a flat pyramid does not spoil the moduli") {
  // Under a stretch of the base of the pyramid its tip moves much more than the strain tells, the
  // more the flatter the pyramid is.
  const MassSpringModel block = test::corners_box(4, 4, 4, 0.1, 1e6, 1000);
  const double height = GENERATE(1e-2, 5e-3, 1e-4);
  const Vec3 tip(0.2, 0.2, 0.4 + height);
  std::vector<Vec3> rest = block.rest;
  std::vector<double> mass = block.mass;
  std::vector<test::TableSpring> springs;
  for (std::uint32_t s = 0; s < block.spring_count(); ++s)
    springs.push_back({block.a[s], block.b[s], block.stiffness[s]});
  for (std::uint32_t i = 0; i < block.node_count(); ++i) {
    const Vec3 way = block.rest[i] - tip;
    if (std::abs(way.z()) < 0.05 && way.norm() > 0.05 && way.norm() < 0.15)
      springs.push_back({i, block.node_count(), block.stiffness[0]});
  }
  rest.push_back(tip);
  mass.push_back(1);  // that of a node inside
  const std::vector<MaterialModuli> found =
      under_smooth_loads(test::table_model(rest, mass, springs));
  REQUIRE(found.size() == 1);
  CHECK(found[0].young == Approx(1e6).epsilon(0.05));
  CHECK(found[0].poisson == Approx(0.25).margin(0.02));
}

TEST_CASE("Bends and twists, whose averages cancel, do not change the moduli") {
  const MassSpringModel model = test::random_model(4, 8);
  std::vector<StaticSolution> solutions = solve_static(elastic_body(model), smooth_loads(model));
  const std::vector<MaterialModuli> all = measured_moduli(model, solutions);
  const std::vector<StaticSolution> cancelling(solutions.begin() + 6, solutions.end());
  CHECK(measured_moduli(model, cancelling).empty());
  solutions.resize(6);
  const std::vector<MaterialModuli> first = measured_moduli(model, solutions);
  REQUIRE(all.size() == 2);
  REQUIRE(first.size() == 2);
  for (std::size_t m = 0; m < all.size(); ++m) CHECK(all[m].young == first[m].young);
}

TEST_CASE("Materials whose moduli are undetermined are omitted") {
  MassSpringModel block = test::corners_box(3, 3, 3, 0.1, 1e6, 1000);
  block.materials.push_back(Material{.name = "skin"});
  block.materials.push_back(Material{.name = "nowhere"});
  Mat3 stretch = Mat3::Zero(), shear = Mat3::Zero();
  stretch(0, 0) = 1;
  shear(0, 1) = 1;
  SECTION("a material of one plane of nodes, another of none") {
    for (std::uint32_t i = 0; i < block.node_count(); ++i)
      block.material[i] = block.rest[i].z() > 0.25 ? 1 : 0;
    const std::vector<MaterialModuli> found = under_smooth_loads(block);
    REQUIRE(found.size() == 1);
    CHECK(found[0].material == 0);
  }
  SECTION("a plane of nodes and a smaller solid cluster") {
    for (std::uint32_t i = 0; i < block.node_count(); ++i) {
      const bool lump = block.rest[i].minCoeff() > 0.15;
      block.material[i] = lump || block.rest[i].z() < 0.05 ? 1 : 0;
    }
    const std::vector<MaterialModuli> found = under_smooth_loads(block);
    REQUIRE(found.size() == 1);
    CHECK(found[0].material == 0);
  }
  SECTION("a material of three nodes") {
    for (std::uint32_t i = 0; i < 3; ++i) block.material[i] = 1;
    REQUIRE(under_smooth_loads(block).size() == 1);
  }
  SECTION("pure shear, which does not determine lambda") {
    CHECK(measured_moduli(block, {affine(block, shear)}).empty());
    const Mat3 tilt = Eigen::AngleAxisd(0.3, Vec3(1, 2, 3).normalized()).toRotationMatrix();
    CHECK(measured_moduli(block, {affine(block, tilt * shear * tilt.transpose())}).empty());
    CHECK(measured_moduli(block, {affine(block, shear), affine(block, stretch)}).size() == 1);
  }
  SECTION("isotropic strain, which does not determine mu") {
    CHECK(measured_moduli(block, {affine(block, Mat3::Identity())}).empty());
  }
  SECTION("zero displacements, or no solutions") {
    CHECK(measured_moduli(block, {affine(block, Mat3::Zero())}).empty());
    CHECK(measured_moduli(block, {}).empty());
  }
}

TEST_CASE("Displacements of another model are rejected") {
  const MassSpringModel block = test::corners_box(3, 3, 3, 0.1, 1e6, 1000);
  const MassSpringModel other = test::corners_box(2, 2, 2, 0.1, 1e6, 1000);
  CHECK_THROWS_AS(measured_moduli(block, {affine(other, Mat3::Identity())}), InputError);
}

}  // namespace
}  // namespace springlod::elastic
