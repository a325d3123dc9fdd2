#include "model/chain.hpp"

#include <catch2/catch.hpp>

#include "base/error.hpp"
#include "tests/support/assets.hpp"

namespace springlod {
namespace {

using Catch::Matchers::Contains;

TEST_CASE("The maps of successive merges compose") {
  const Groups finer{{0, 0, 1, 2, 2, 3}, 4};
  const Groups coarser{{1, 0, 0, 1}, 2};
  const Groups both = compose(finer, coarser);
  CHECK(both.of == std::vector<std::uint32_t>{1, 1, 0, 0, 0, 1});
  CHECK(both.count == 2);
  CHECK(compose(identity_groups(6), finer).of == finer.of);
  CHECK(compose(finer, identity_groups(4)).of == finer.of);
  CHECK_THROWS_WITH(compose(coarser, finer), Contains("2 groups") && Contains("has 6 entries"));
}

TEST_CASE("Group numbers must be below the count, and every group has a node") {
  CHECK_NOTHROW(validate(Groups{{1, 0, 1}, 2}));
  CHECK_THROWS_WITH(validate(Groups{{0, 2}, 2}), Contains("node 2") && Contains("group 3"));
  CHECK_THROWS_WITH(validate(Groups{{0, 2}, 3}), Contains("group 2 is empty"));
}

TEST_CASE("Provenance keeps its order and one value for each key") {
  Provenance p;
  p.set("seed", "1");
  p.set("cell", "2 mm");
  p.set("seed", "3");
  CHECK(p.entries ==
        std::vector<std::pair<std::string, std::string>>{{"seed", "3"}, {"cell", "2 mm"}});
}

TEST_CASE("An invalid asset is rejected with the number of the level") {
  LodAsset asset = test::sample_asset();
  CHECK_NOTHROW(validate(asset));
  SECTION("a model") {
    asset.chain.levels[2].model.stiffness[1] = 0;
    CHECK_THROWS_WITH(validate(asset), Contains("level 2") && Contains("spring 2"));
  }
  SECTION("a map of the wrong length") {
    asset.chain.levels[1].of_base.of.pop_back();
    CHECK_THROWS_WITH(validate(asset), Contains("level 1") && Contains("map"));
  }
  SECTION("no levels") {
    asset.chain.levels.clear();
    CHECK_THROWS_WITH(validate(asset), Contains("no levels"));
  }
  SECTION("a vertex that is not bound") {
    asset.surface_of_base = bind_points({}, asset.chain.levels[0].model);
    CHECK_THROWS_WITH(validate(asset), Contains("8 vertices"));
  }
  SECTION("a vertex bound to a missing node") {
    asset.surface_of_base.node[5] = 80;
    CHECK_THROWS_WITH(validate(asset), Contains("entry 6") && Contains("node 81"));
  }
  SECTION("a vertex beyond all planets") {
    asset.surface.positions[4].z() = -1e300;
    CHECK_THROWS_WITH(validate(asset), Contains("vertex 5") && Contains("-1e+300 m"));
  }
  SECTION("rows of the binding out of order") {
    std::swap(asset.surface_of_base.start[2], asset.surface_of_base.start[3]);
    CHECK_THROWS_AS(validate(asset), InputError);
  }
  SECTION("a surface triangle out of range") {
    asset.surface.triangles[3][1] = 8;
    CHECK_THROWS_WITH(validate(asset), Contains("triangle 4"));
  }
}

}  // namespace
}  // namespace springlod
