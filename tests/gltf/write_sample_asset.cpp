// write_sample_asset FOLDER: writes the assets that the Khronos validator is run on.

#include <exception>
#include <filesystem>
#include <iostream>
#include <vector>

#include "model/asset/asset.hpp"
#include "tests/support/assets.hpp"

int main(int argc, char** argv) try {
  if (argc != 2) {
    std::cerr << "usage: write_sample_asset FOLDER\n";
    return 2;
  }
  const std::filesystem::path folder = argv[1];
  springlod::LodAsset asset = springlod::test::sample_asset();
  springlod::save_asset(asset, folder / "chain.glb");
  std::vector<springlod::SlimLevel> slim(asset.chain.levels.size(), {{}, 1e-3});
  for (std::size_t n = 1; n < slim.size(); ++n)
    slim[n].of_level =
        springlod::bind_points(asset.chain.levels[0].model.rest, asset.chain.levels[n].model);
  springlod::save_slim_asset(asset, slim, folder / "slim.glb");

  // No surface, no springs, a single node: all optional elements are omitted.
  springlod::LodAsset bare;
  bare.chain.levels.resize(1);
  bare.chain.levels[0].model = springlod::test::make_model({{1, 2, 3}}, {});
  bare.chain.levels[0].of_base = springlod::identity_groups(1);
  springlod::save_asset(bare, folder / "bare.glb");
  springlod::save_slim_asset(bare, {{{}, 1e-3}}, folder / "bare-slim.glb");

  // No surface: the scene shows springs.
  bare.chain.levels[0].model = springlod::test::box_lattice(4, 3, 2);
  bare.chain.levels[0].of_base = springlod::identity_groups(24);
  springlod::save_slim_asset(bare, {{{}, 1e-3}}, folder / "springs-slim.glb");
  return 0;
} catch (const std::exception& e) {
  std::cerr << e.what() << '\n';
  return 1;
}
