#include "model/asset/slim_asset.hpp"

#include <cmath>
#include <filesystem>
#include <string>
#include <vector>

#include <catch2/catch.hpp>

#include "base/error.hpp"
#include "base/file.hpp"
#include "model/asset/asset.hpp"
#include "model/node_dilatation.hpp"
#include "tests/support/assets.hpp"
#include "tests/support/dilatation.hpp"
#include "tests/support/lattices.hpp"
#include "tests/support/temporary_folder.hpp"

namespace springlod {
namespace {

using Catch::Matchers::Contains;
using test::sample_asset;
using test::TemporaryFolder;

/// What a program that knows the levels would give: level 0 bound to each of them.
std::vector<SlimLevel> slim_levels(const LodAsset& asset) {
  std::vector<SlimLevel> levels;
  for (const Level& level : asset.chain.levels) {
    SlimLevel& slim = levels.emplace_back();
    slim.stable_step = 1e-3 / static_cast<double>(levels.size());
    if (levels.size() > 1)
      slim.of_level = bind_points(asset.chain.levels[0].model.rest, level.model);
  }
  return levels;
}

LodAsset written_and_read(const LodAsset& asset) {
  const TemporaryFolder scratch;
  save_slim_asset(asset, slim_levels(asset), scratch / "slim.glb");
  return load_asset(scratch / "slim.glb");
}

void check_same(const MassSpringModel& a, const MassSpringModel& b) {
  CHECK(a.rest == b.rest);
  CHECK(a.mass == b.mass);
  CHECK(a.volume == b.volume);
  CHECK(a.contact_area == b.contact_area);
  CHECK(a.border == b.border);
  CHECK(a.material == b.material);
  CHECK(a.a == b.a);
  CHECK(a.b == b.b);
  CHECK(a.rest_length == b.rest_length);
  CHECK(a.stiffness == b.stiffness);
  CHECK(a.damping == b.damping);
  CHECK(a.corners == b.corners);
  CHECK(a.dilatation.modulus == b.dilatation.modulus);
  CHECK(a.dilatation.damping_time == b.dilatation.damping_time);
  CHECK(a.dilatation.start == b.dilatation.start);
  CHECK(a.dilatation.node == b.dilatation.node);
  CHECK(a.dilatation.gradient == b.dilatation.gradient);
  CHECK(a.surface.of_nodes.start == b.surface.of_nodes.start);
  CHECK(a.surface.of_nodes.node == b.surface.of_nodes.node);
  CHECK(a.surface.of_nodes.weight == b.surface.of_nodes.weight);
  CHECK(a.surface.normal == b.surface.normal);
  CHECK(a.surface.area == b.surface.area);
  CHECK(a.surface.stiffness == b.surface.stiffness);
  CHECK(a.materials == b.materials);
}

void check_same(const LodAsset& a, const LodAsset& b) {
  REQUIRE(a.chain.levels.size() == b.chain.levels.size());
  for (std::size_t n = 0; n < a.chain.levels.size(); ++n) {
    CHECK(a.chain.levels[n].of_base.of == b.chain.levels[n].of_base.of);
    CHECK(a.chain.levels[n].made_by == b.chain.levels[n].made_by);
    CHECK_FALSE(b.chain.levels[n].certificate);
    check_same(a.chain.levels[n].model, b.chain.levels[n].model);
  }
  CHECK(a.surface.positions == b.surface.positions);
  CHECK(a.surface.triangles == b.surface.triangles);
  CHECK(a.surface_of_base.start == b.surface_of_base.start);
  CHECK(a.surface_of_base.node == b.surface_of_base.node);
  CHECK(a.surface_of_base.weight == b.surface_of_base.weight);
  CHECK(a.provenance.entries == b.provenance.entries);
}

/// A base of `model` alone, without a surface.
LodAsset asset_of(const MassSpringModel& model) {
  LodAsset asset;
  asset.chain.levels.push_back({model, identity_groups(model.node_count()), "base"});
  return asset;
}

double largest_difference(const std::vector<Vec3>& a, const std::vector<Vec3>& b) {
  REQUIRE(a.size() == b.size());
  double largest = 0;
  for (std::size_t i = 0; i < a.size(); ++i) largest = std::max(largest, (a[i] - b[i]).norm());
  return largest;
}

}  // namespace

TEST_CASE("A slim asset is read as what slimming makes of the asset, bit for bit") {
  LodAsset asset = sample_asset();
  asset.chain.levels[1].certificate = test::sample_certificate();
  const LodAsset slim = slimmed(asset);
  check_same(slim, written_and_read(asset));
  const MassSpringModel& read = slim.chain.levels[2].model;
  for (std::uint32_t s = 0; s < read.spring_count(); ++s)
    CHECK(read.rest_length[s] == (read.rest[read.b[s]] - read.rest[read.a[s]]).norm());
  // It is close to the asset, and not the asset.
  const MassSpringModel& before = asset.chain.levels[0].model;
  const MassSpringModel& after = slim.chain.levels[0].model;
  CHECK(after.stiffness != before.stiffness);
  for (std::uint32_t s = 0; s < before.spring_count(); ++s)
    CHECK(after.stiffness[s] == Approx(before.stiffness[s]).epsilon(6e-8));
  CHECK(largest_difference(after.rest, before.rest) < 1e-8);
  CHECK(slim.provenance.entries.back().first == "slim");
}

TEST_CASE("Slim assets have dilatation terms, contact surfaces and lengths of springs under load") {
  MassSpringModel model = test::lattice_with_terms(5, 4, 3);
  for (Vec3& x : model.rest) x = x / 3 + Vec3(0.1, 0.2, 0.3);
  for (Vec3& b : model.dilatation.gradient) b *= 3;
  for (std::uint32_t s = 0; s < model.spring_count(); ++s)
    model.rest_length[s] = (model.rest[model.b[s]] - model.rest[model.a[s]]).norm();
  model.rest_length[7] *= 0.9;
  model.surface.of_nodes = bind_points({{0.1, 0.2, 0.4}, {0.7, 0.8, 0.9}}, model);
  model.surface.normal = {Vec3(1, 2, 2) / 3, Vec3(0, 0, -1)};
  model.surface.area = {0.1, 0.2};
  model.surface.stiffness = {1.0 / 3, 7};
  const LodAsset asset = asset_of(model);
  const LodAsset slim = slimmed(asset);
  check_same(slim, written_and_read(asset));
  const MassSpringModel& after = slim.chain.levels[0].model;
  CHECK(after.rest_length[7] == Approx(model.rest_length[7]).epsilon(1e-7));
  // The terms have no force at rest.
  CHECK(after.rest_length[8] == Approx(model.rest_length[8]).epsilon(1e-7));
  for (std::uint32_t t = 0; t < after.dilatation.count(); ++t)
    CHECK(std::abs(volume_ratio(mean_gradient(after.dilatation, t, after.rest)).value - 1) < 5e-7);
}

TEST_CASE("Slim assets of one node and of many nodes are read back") {
  check_same(slimmed(asset_of(test::make_model({{1, 2, 3}}, {}))),
             written_and_read(asset_of(test::make_model({{1, 2, 3}}, {}))));
  // Node numbers of 8 and of 16 bits, and a bound beyond which they need the next size.
  for (const int n : {254, 255, 256, 257, 65535, 65537}) {
    const LodAsset asset = asset_of(test::box_lattice(n, 1, 1));
    check_same(slimmed(asset), written_and_read(asset));
  }
}

TEST_CASE("A slim binding keeps affine motions and drops small weights") {
  const MassSpringModel model = test::box_lattice(6, 6, 6, 0.1);
  std::vector<Vec3> points;
  for (int i = 0; i < 200; ++i)
    points.emplace_back(0.55 * std::abs(std::sin(i)), 0.55 * std::abs(std::cos(3 * i)), -0.03);
  const Binding whole = bind_points(points, model);
  const Binding slim = slim_binding(whole, model.rest);
  CHECK(slim.node.size() < 0.95 * static_cast<double>(whole.node.size()));
  for (std::uint32_t p = 0; p < slim.point_count(); ++p) {
    double sum = 0;
    for (std::uint32_t e = slim.start[p]; e < slim.start[p + 1]; ++e) {
      sum += slim.weight[e];
      CHECK(std::ldexp(slim.weight[e], 14) == std::round(std::ldexp(slim.weight[e], 14)));
    }
    CHECK(sum == 1);
  }
  Mat3 gradient;
  gradient << 1.1, 0.2, -0.1, 0.3, 0.8, 0.1, -0.2, 0.1, 1.2;
  std::vector<Vec3> moved;
  for (const Vec3& x : model.rest) moved.push_back(gradient * x + Vec3(1, 2, 3));
  // 8 weights, each rounded by at most 2^-15, times distances of at most 0.3 m.
  CHECK(largest_difference(interpolate(slim, moved), interpolate(whole, moved)) < 5e-5);
}

TEST_CASE("A slim binding keeps rows whose other nodes cannot replace the small weights") {
  // Four nodes of a tetrahedron: each has its part in an affine motion.
  const std::vector<Vec3> rest{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  Binding binding;
  binding.start = {0, 4};
  binding.node = {0, 1, 2, 3};
  binding.weight = {0.57, 0.2, 0.2, 0.03};
  const Binding slim = slim_binding(binding, rest);
  CHECK(slim.node == binding.node);
  for (std::size_t e = 0; e < 4; ++e)
    CHECK(slim.weight[e] == Approx(binding.weight[e]).margin(1e-4));
  CHECK(slim_binding({}, rest).start.empty());
}

TEST_CASE("Large weights take a larger unit") {
  CHECK(weight_unit({0.5, -1.5}) == std::ldexp(1, -14));
  CHECK(weight_unit({2.5}) == std::ldexp(1, -13));
  CHECK(weight_unit({-100}) == std::ldexp(1, -8));
}

TEST_CASE("Bodies that single precision cannot hold are refused with what to do") {
  MassSpringModel model = test::box_lattice(3, 3, 3, 0.001);
  for (Vec3& x : model.rest) x += Vec3(1e6, 0, 0);
  const TemporaryFolder scratch;
  const LodAsset asset = asset_of(model);
  CHECK_THROWS_WITH(save_slim_asset(asset, slim_levels(asset), scratch / "far.glb"),
                    Contains("single precision") && Contains("coincide") && Contains("origin"));
  CHECK_FALSE(std::filesystem::exists(scratch / "far.glb"));
  CHECK_THROWS_AS(save_slim_asset(asset, {}, scratch / "far.glb"), InputError);
}

TEST_CASE("A damaged slim asset is refused") {
  const TemporaryFolder scratch;
  const LodAsset asset = sample_asset();
  save_slim_asset(asset, slim_levels(asset), scratch / "slim.glb");
  const std::string whole = read_file(scratch / "slim.glb");
  const auto refuses = [&](const std::string& before, const std::string& after,
                           const std::string& reason) {
    std::string file = whole;
    const std::size_t at = file.find(before);
    REQUIRE(at != std::string::npos);
    REQUIRE(before.size() == after.size());
    file.replace(at, before.size(), after);
    CAPTURE(before, after);
    CHECK_THROWS_WITH(parse_asset(file, "slim.glb"), Contains("damaged") && Contains(reason));
  };
  refuses(R"("version":6})", R"("version":4})", "must be a number");
  refuses(R"("width":3)", R"("width":2)", "must have 3 numbers");
  refuses(R"("type":"float32")", R"("type":"float33")", "unknown type float33");
  refuses(R"("type":"int16")", R"("type":"uint8")", "has");
  refuses(R"("ends":{"type":"uint8")", R"("ends":{"type":"int16")", "has");
  refuses(R"("scale":)", R"("scala":)", "weight");
  refuses(R"("stableStep":0.001)", R"("stableStep":0.002)", "checksum");
}

}  // namespace springlod
