// Time of each stage of the main workflow. Run by ./dev bench.

#include <cmath>
#include <filesystem>
#include <memory>
#include <numbers>

#include <benchmark/benchmark.h>

#include "lod/build.hpp"
#include "lod/transfer.hpp"
#include "model/asset/asset.hpp"
#include "render/frames.hpp"
#include "render/scene.hpp"
#include "report/animate.hpp"
#include "report/video.hpp"
#include "sim/study/compare.hpp"
#include "voxelize/lattice/lattice.hpp"

namespace {

using namespace springlod;

voxelize::MaterialGrid cube_grid(int side) {
  voxelize::MaterialGrid grid;
  grid.cell = 0.01;
  grid.materials = {Material{.name = "block", .damping = 0.0002}};
  for (int z = 0; z < side; ++z)
    for (int y = 0; y < side; ++y)
      for (int x = 0; x < side; ++x) grid.cells.push_back({x, y, z});
  grid.material.assign(grid.cells.size(), 0);
  grid.depth.assign(grid.cells.size(), 0);
  return grid;
}

// 46^3 cells: 103,823 nodes, 901,554 springs.
constexpr int kSide = 46;

void build_lattice_100k(benchmark::State& state) {
  const voxelize::MaterialGrid grid = cube_grid(kSide);
  for (auto _ : state) benchmark::DoNotOptimize(voxelize::build_lattice(grid).model.node_count());
}
BENCHMARK(build_lattice_100k)->Unit(benchmark::kMillisecond);

void merge_two_levels_100k(benchmark::State& state) {
  const MassSpringModel base = voxelize::build_lattice(cube_grid(kSide)).model;
  for (auto _ : state) benchmark::DoNotOptimize(lod::simplify(base, {.levels = 2}).levels.size());
  state.SetItemsProcessed(state.iterations() * base.node_count());
}
BENCHMARK(merge_two_levels_100k)->Unit(benchmark::kMillisecond);

void build_merge_and_save_100k(benchmark::State& state) {
  const auto path = std::filesystem::temp_directory_path() / "springlod_bench.glb";
  const voxelize::MaterialGrid grid = cube_grid(kSide);
  for (auto _ : state) {
    LodAsset asset;
    asset.chain = lod::simplify(voxelize::build_lattice(grid).model, {.levels = 2});
    save_asset(asset, path);
  }
  std::filesystem::remove(path);
}
BENCHMARK(build_merge_and_save_100k)->Unit(benchmark::kMillisecond)->UseRealTime();

// A sphere of rings x sectors vertices, bound to the dumbbell-sized block below.
TriangleMesh sphere_mesh(std::uint32_t rings, std::uint32_t sectors, double radius,
                         const Vec3& center) {
  TriangleMesh mesh;
  for (std::uint32_t r = 0; r <= rings; ++r)
    for (std::uint32_t s = 0; s < sectors; ++s) {
      const double polar = std::numbers::pi * r / rings;
      const double around = 2 * std::numbers::pi * s / sectors;
      mesh.positions.emplace_back(center + radius * Vec3(std::sin(polar) * std::cos(around),
                                                         std::sin(polar) * std::sin(around),
                                                         std::cos(polar)));
    }
  for (std::uint32_t r = 0; r < rings; ++r)
    for (std::uint32_t s = 0; s < sectors; ++s) {
      const std::uint32_t i = r * sectors + s;
      const std::uint32_t j = r * sectors + (s + 1) % sectors;
      mesh.triangles.push_back({i, i + sectors, j});
      mesh.triangles.push_back({j, i + sectors, j + sectors});
    }
  mesh.parts.push_back({"sphere", "block", 0, static_cast<std::uint32_t>(mesh.triangles.size())});
  return mesh;
}

// 60 frames of three panels of 640 x 480 with a surface of 20,000 triangles, drawn and encoded.
void animate_60_frames(benchmark::State& state) {
  const auto folder = std::filesystem::temp_directory_path() / "springlod_bench_frames";
  LodAsset asset;
  asset.chain = lod::simplify(voxelize::build_lattice(cube_grid(8)).model, {.levels = 2});
  asset.surface = sphere_mesh(100, 100, 0.04, Vec3::Constant(0.04));
  asset.surface_of_base = bind_points(asset.surface.positions, asset.chain.levels[0].model);
  sim::Scenario scene;
  scene.duration = 2;
  scene.obstacles = {{.shape = sim::Plane{.offset = -0.2}, .name = "floor", .stiffness = 1e7}};
  const sim::Comparison runs = sim::compare(asset.chain, scene, {.run = {.frame_rate = 30}});
  for (auto _ : state) {
    benchmark::DoNotOptimize(
        report::animate({{asset, runs}}, folder, {.frame_rate = 30, .frames = 60}));
    report::encode_video(folder, 30, folder / "bench.mp4");
  }
  std::filesystem::remove_all(folder);
}
BENCHMARK(animate_60_frames)->Unit(benchmark::kSecond)->Iterations(1)->UseRealTime();

// A still image of 640 x 480 of a surface of 20,000 triangles; with argument 1 the context is
// reused.
void draw_still(benchmark::State& state) {
  const TriangleMesh surface = sphere_mesh(100, 100, 0.04, Vec3::Zero());
  render::DrawnBody body;
  body.surface = &surface;
  render::Panel panel;
  panel.bodies = {body};
  panel.camera = render::frame_box(bounds(surface), -70, 15, 4. / 3);
  const render::PanelGrid grid{.panel_width = 640, .panel_height = 480};
  auto renderer = std::make_unique<render::Renderer>(grid);
  for (auto _ : state) {
    if (state.range(0) == 1)
      renderer->lay_out(grid);
    else
      renderer = std::make_unique<render::Renderer>(grid);
    benchmark::DoNotOptimize(renderer->draw({panel}));
  }
}
BENCHMARK(draw_still)
    ->ArgName("kept")
    ->Arg(0)
    ->Arg(1)
    ->Unit(benchmark::kMillisecond)
    ->MeasureProcessCPUTime()
    ->UseRealTime();

}  // namespace

BENCHMARK_MAIN();
