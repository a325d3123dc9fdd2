// Elastic analysis of 20k nodes on one core. Run by ./dev bench.

#include <benchmark/benchmark.h>

#include "elastic/elastic_body.hpp"
#include "elastic/loads.hpp"
#include "elastic/modes.hpp"
#include "voxelize/lattice/lattice.hpp"

namespace {

using namespace springlod;

/// A block of three layers of different materials, the soft one in the middle.
MassSpringModel block(int nx, int ny, int nz) {
  voxelize::MaterialGrid grid;
  grid.cell = 0.01;
  grid.materials = {Material{.name = "steel", .young = 1e7, .density = 2000, .damping = 0.0002},
                    Material{.name = "rubber", .young = 2e5, .damping = 0.0002},
                    Material{.name = "wood", .damping = 0.0002}};
  for (int z = 0; z < nz; ++z)
    for (int y = 0; y < ny; ++y)
      for (int x = 0; x < nx; ++x) {
        grid.cells.push_back({x, y, z});
        grid.material.push_back(static_cast<std::uint16_t>(3 * z / nz));
      }
  grid.depth.assign(grid.cells.size(), 0);
  return voxelize::build_lattice(grid).model;
}

// A cube, which has the most fill-in of all shapes, and a plate: 19,683 and 20,412 nodes.
MassSpringModel cube() {
  return block(26, 26, 26);
}
MassSpringModel plate() {
  return block(80, 41, 5);
}

void factorise(benchmark::State& state, const MassSpringModel& model) {
  for (auto _ : state) benchmark::DoNotOptimize(elastic::elastic_body(model).components.size());
  state.counters["nodes"] = model.node_count();
}

void twenty_modes(benchmark::State& state, const MassSpringModel& model) {
  for (auto _ : state) benchmark::DoNotOptimize(elastic::lowest_modes(model).modes.size());
  state.counters["nodes"] = model.node_count();
}

void nine_loads(benchmark::State& state, const MassSpringModel& model) {
  const elastic::ElasticBody body = elastic::elastic_body(model);
  const std::vector<elastic::StaticLoad> loads = elastic::smooth_loads(model);
  for (auto _ : state) benchmark::DoNotOptimize(elastic::solve_static(body, loads).size());
  state.counters["nodes"] = model.node_count();
}

BENCHMARK_CAPTURE(factorise, cube_20k, cube())->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(twenty_modes, cube_20k, cube())->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(twenty_modes, plate_20k, plate())->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(nine_loads, cube_20k, cube())->Unit(benchmark::kMillisecond);

}  // namespace

BENCHMARK_MAIN();
