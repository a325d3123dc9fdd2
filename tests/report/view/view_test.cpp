#include "report/view/view.hpp"

#include <set>

#include <catch2/catch.hpp>

#include "base/error.hpp"
#include "lod/transfer.hpp"
#include "report/view/coarse_surface.hpp"
#include "tests/render/bodies.hpp"

using namespace springlod;
using namespace springlod::report;
using namespace springlod::test;

namespace {

// A bar of two levels with a surface; a run of each that moves along x at 1 m/s for 2 s.
struct Moving {
  LodAsset asset;
  sim::Comparison comparison;

  Moving() {
    Level base{bar(), {}, "base"};
    base.of_base = identity_groups(base.model.node_count());
    asset.chain.levels = {base, base};
    asset.surface = dumbbell_mesh(16);
    asset.surface_of_base = bind_points(asset.surface.positions, base.model);
    comparison.scenario.obstacles = {{sim::Plane{Vec3::UnitZ(), 0}, "floor"}};
    for (std::uint32_t level = 0; level < 2; ++level) {
      sim::LevelRuns runs;
      runs.label = level == 0 ? "base" : "level 1";
      runs.level = level;
      for (int k = 0; k <= 2 - static_cast<int>(level); ++k) {  // the level ends after 1 s
        std::vector<Vec3> x = base.model.rest;
        for (Vec3& p : x) p.x() += k;
        runs.first.frames.push_back({static_cast<double>(k), x});
      }
      comparison.levels.push_back(runs);
    }
  }

  View view(const ViewOptions& options = {}) const {
    return view_of({{asset, comparison}}, options);
  }
};

}  // namespace

TEST_CASE("a view has every level at evenly spaced times of the longest run") {
  const Moving moving;
  const View view = moving.view({.frames = 5});
  CHECK(view.times == std::vector<double>{0, 0.5, 1, 1.5, 2});
  REQUIRE(view.bodies.size() == 2);
  CHECK(view.bodies[0].label == "base");
  CHECK(view.bodies[1].label == "level 1");
  const Vec3 rest = moving.asset.chain.levels[0].model.rest[0];
  CHECK((view.bodies[0].frames[1][0] - rest).x() == Approx(0.5));
  CHECK((view.bodies[0].frames[4][0] - rest).x() == Approx(2));
  CHECK((view.bodies[1].frames[4][0] - rest).x() == Approx(1));  // it stays where it ended
  const MassSpringModel& model = moving.asset.chain.levels[0].model;
  CHECK(view.bodies[0].ends.size() == model.spring_count());
  CHECK(view.bodies[0].ends[0] == std::array<std::uint32_t, 2>{model.a[0], model.b[0]});
  CHECK(view.bodies[0].to_base.point_count() == 0);
  CHECK(view.bodies[1].to_base.point_count() == model.node_count());
  CHECK(view.obstacles.size() == 1);
  CHECK(view.left_out.empty());
}

TEST_CASE("the surface of a view follows the nodes of the base") {
  const Moving moving;
  const View view = moving.view();
  REQUIRE(view.triangles.size() == moving.asset.surface.triangles.size());
  const std::vector<Vec3> drawn =
      interpolate(view.surface, moving.asset.chain.levels[0].model.rest);
  const std::vector<Vec3>& mesh = moving.asset.surface.positions;
  for (std::size_t t = 0; t < view.triangles.size(); ++t)
    for (int k = 0; k < 3; ++k)
      CHECK((drawn[view.triangles[t][k]] - mesh[moving.asset.surface.triangles[t][k]]).norm() <
            1e-9);
}

TEST_CASE("what does not fit into the bytes of a view is left out, and said") {
  const Moving moving;
  const auto nodes = static_cast<double>(moving.asset.chain.levels[0].model.node_count());
  const View fewer = moving.view({.frames = 1000, .bytes = 3e5});
  CHECK(fewer.times.size() < 1000);
  CHECK(fewer.times.size() > 1);
  REQUIRE(!fewer.left_out.empty());
  CHECK_THAT(fewer.left_out.back(), Catch::Contains("The motion has"));

  // One level with twelve frames of 8 bytes a node, and neither surface nor springs.
  const View one = moving.view({.bytes = 100 * nodes});
  CHECK(one.bodies.size() == 1);
  CHECK(one.triangles.empty());
  CHECK(one.bodies[0].ends.empty());
  CHECK(one.times.size() == 12);
  CHECK_THROWS_WITH(moving.view({.bytes = nodes}), Catch::Contains("increase bytes"));
}

TEST_CASE("levels at rest have one instant, and runs of another base are refused") {
  const Moving moving;
  const View still = view_of(moving.asset);
  CHECK(still.times == std::vector<double>{0});
  CHECK(still.bodies[1].label == "level 1");
  CHECK(still.bodies[1].frames[0] == moving.asset.chain.levels[1].model.rest);

  Moving other;
  other.asset.chain.levels[0].model.rest[0].x() += 1e-3;
  CHECK_THROWS_WITH(view_of({{moving.asset, moving.comparison}, {other.asset, other.comparison}}),
                    Catch::Contains("comparison 2"));
  Moving blind;
  blind.comparison.levels[1].first.frames.clear();
  CHECK_THROWS_WITH(blind.view(), Catch::Contains("level 1") && Catch::Contains("frame rate"));
}

TEST_CASE("a coarse surface has at most as many triangles as asked, of vertices of the mesh") {
  const TriangleMesh mesh = dumbbell_mesh(32);
  const auto all = static_cast<std::uint32_t>(mesh.triangles.size());
  const CoarseSurface same = coarse_surface(mesh, all);
  REQUIRE(same.triangles.size() == all);
  for (std::uint32_t t = 0; t < all; ++t)
    for (int k = 0; k < 3; ++k) CHECK(same.vertex[same.triangles[t][k]] == mesh.triangles[t][k]);
  const CoarseSurface coarse = coarse_surface(mesh, all / 4);
  CHECK(coarse.triangles.size() <= all / 4);
  CHECK(coarse.triangles.size() > all / 16);
  std::set<std::uint32_t> used;
  for (const Triangle& triangle : coarse.triangles) {
    used.insert(triangle.begin(), triangle.end());
    CHECK(std::set<std::uint32_t>(triangle.begin(), triangle.end()).size() == 3);
  }
  CHECK(used.size() == coarse.vertex.size());
  CHECK(*used.rbegin() + 1 == coarse.vertex.size());
  Box3 box;
  for (const std::uint32_t v : coarse.vertex) box.extend(mesh.positions[v]);
  const Vec3 lost = bounds(mesh).sizes() - box.sizes();
  CHECK(lost.maxCoeff() < 0.25 * bounds(mesh).diagonal().norm());
}
