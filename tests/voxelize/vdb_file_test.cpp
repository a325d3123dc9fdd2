#include "voxelize/vdb_file.hpp"

#include <random>

#include <catch2/catch.hpp>

#include "base/error.hpp"
#include "base/file.hpp"
#include "tests/support/cut_ball.hpp"
#include "tests/support/temporary_folder.hpp"
#include "tests/voxelize/grids.hpp"
#include "tests/voxelize/shapes.hpp"

namespace springlod::voxelize {

using namespace springlod::test;
using Catch::Matchers::Contains;
namespace fs = std::filesystem;

namespace {

void check_same(const MaterialGrid& l, const MaterialGrid& r) {
  CHECK(l.cell == r.cell);
  CHECK(l.origin == r.origin);
  CHECK(l.cells == r.cells);
  CHECK(l.material == r.material);
  CHECK(l.depth == r.depth);
  CHECK(l.materials == r.materials);
  CHECK((l.distance == nullptr) == (r.distance == nullptr));
}

}  // namespace

TEST_CASE("A voxelized mesh is restored from a .vdb file") {
  const TemporaryFolder folder;
  TriangleMesh mesh;
  add_sphere(mesh, "ball", {0.1, 0.2, 0.3}, 1);
  VoxelizeOptions options;
  options.fallback = {{"shell", 1.1e5, 333, 0.00123, {0.1F, 0.2F, 0.3F}}, std::nullopt};
  options.core_shell = {0.3, {{"core", 7.7e6, 1234.5, 0, {0.9F, 0.8F, 0.7F}}}};
  const MaterialGrid grid = voxelize::voxelize(mesh, options).grid;
  save_vdb(grid, folder / "made/ball.vdb");
  const MaterialGrid loaded = load_vdb(folder / "made/ball.vdb");
  check_same(grid, loaded);
  // A loaded grid can be saved again, including its level set.
  save_vdb(loaded, folder / "again.vdb");
  check_same(grid, load_vdb(folder / "again.vdb"));
}

TEST_CASE("Cut cells and the points of the surface are restored from a .vdb file") {
  const TemporaryFolder folder;
  const MaterialGrid grid = cut_ball_grid(7.3);
  save_vdb(grid, folder / "cut.vdb");
  const MaterialGrid loaded = load_vdb(folder / "cut.vdb");
  check_same(grid, loaded);
  CHECK(loaded.fraction == grid.fraction);
  REQUIRE(loaded.surface.size() == grid.surface.size());
  for (std::size_t p = 0; p < grid.surface.size(); ++p) {
    const SurfacePoint& was = grid.surface[p];
    const SurfacePoint& is = loaded.surface[p];
    CHECK(is.cell == was.cell);
    CHECK(is.area == was.area);
    CHECK(is.normal == was.normal);
    for (std::size_t d = 0; d < 3; ++d) CHECK(is.place[d] == Approx(was.place[d]).margin(1e-6));
  }
}

TEST_CASE("A grid without level set, with negative cell indices, is restored") {
  const TemporaryFolder folder;
  MaterialGrid grid = grid_of({{-70, 3, 900}, {0, 0, 0}, {-1, -1, -1}, {-1, 0, 0}}, 0.013);
  grid.origin = Vec3(0.1, -0.7, 1.0 / 3);
  grid.material[2] = 1;
  grid.materials[1].poisson = 0.45;
  grid.depth.clear();
  save_vdb(grid, folder / "table.vdb");
  check_same(grid, load_vdb(folder / "table.vdb"));
}

TEST_CASE("A file that springlod did not write is rejected") {
  const TemporaryFolder folder;
  const auto refused = [](const fs::path& path, const std::string& with) {
    CHECK_THROWS_AS(load_vdb(path), IoError);
    CHECK_THROWS_WITH(load_vdb(path), Contains(with));
  };
  refused(folder / "nowhere.vdb", "No such file");
  refused(folder.path(), "is a folder");
  write_text_file(folder / "text.vdb", "hello, this is not a grid");
  refused(folder / "text.vdb", "is not a .vdb file");
  write_text_file(folder / "empty.vdb", "");
  refused(folder / "empty.vdb", "is not a .vdb file");
}

TEST_CASE("A truncated .vdb file is rejected") {
  const TemporaryFolder folder;
  save_vdb(box_grid(20, 20, 20), folder / "whole.vdb");
  const std::string bytes = read_file(folder / "whole.vdb");
  for (const std::size_t length : {std::size_t{8}, std::size_t{40}, bytes.size() / 2}) {
    write_text_file(folder / "cut.vdb", bytes.substr(0, length));
    CHECK_THROWS_AS(load_vdb(folder / "cut.vdb"), IoError);
  }
}

TEST_CASE("A changed .vdb file is refused by its hash, and without one does no harm") {
  const TemporaryFolder folder;
  save_vdb(box_grid(9, 9, 9), folder / "whole.vdb");
  const std::string bytes = read_file(folder / "whole.vdb");
  const std::string no_hash = bytes.substr(0, bytes.rfind('\n'));
  CHECK(no_hash.size() + 40 == bytes.size());
  write_text_file(folder / "plain.vdb", no_hash);
  CHECK(load_vdb(folder / "plain.vdb").cells.size() == 729);
  std::mt19937 random(1);
  for (int i = 0; i < 40; ++i) {
    // The magic number stays; the file is a .vdb file for certain.
    const std::size_t at = 8 + random() % (no_hash.size() - 8);
    const auto change = static_cast<char>(1 + random() % 255);
    std::string changed = bytes;
    changed[at] = static_cast<char>(changed[at] ^ change);
    write_text_file(folder / "changed.vdb", changed);
    CHECK_THROWS_WITH(load_vdb(folder / "changed.vdb"), Contains("does not have the hash"));
    write_text_file(folder / "changed.vdb", changed.substr(0, no_hash.size()));
    try {
      load_vdb(folder / "changed.vdb");
    } catch (const IoError& error) {
      CHECK(std::string(error.what()).size() < 1000);
    }
  }
}

TEST_CASE("An invalid grid is not saved") {
  const TemporaryFolder folder;
  MaterialGrid grid = box_grid(2, 2, 2);
  grid.material[0] = 9;
  CHECK_THROWS_AS(save_vdb(grid, folder / "bad.vdb"), InputError);
  CHECK_FALSE(fs::exists(folder / "bad.vdb"));
}

}  // namespace springlod::voxelize
