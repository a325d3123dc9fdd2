#include "report/part_materials.hpp"

#include <algorithm>

#include <catch2/catch.hpp>

#include "tests/support/assets.hpp"

using springlod::LodAsset;
using springlod::report::part_materials;
using springlod::test::sample_asset;

TEST_CASE("a mesh part has the material of its name, or that to which it is bound") {
  LodAsset asset = sample_asset();
  auto& parts = asset.surface.parts;
  auto& base = asset.chain.levels.front().model;
  REQUIRE(parts.size() == 2);
  // Every node is rubber, but the first part is named after steel.
  std::fill(base.material.begin(), base.material.end(), 1);
  parts[0].material = "steel";
  parts[1].material = "unknown";
  CHECK(part_materials(asset) == std::vector<std::uint32_t>{0, 1});
  parts[0].material.clear();
  parts[0].name = "rubber";
  std::fill(base.material.begin(), base.material.end(), 0);
  CHECK(part_materials(asset) == std::vector<std::uint32_t>{1, 0});
}
