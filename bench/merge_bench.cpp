// Merging a lattice of a million nodes from level 0 to level 1, compared with meshoptimizer's
// simplify of a surface of a million vertices to the same fraction. One thread. Run by ./dev bench.

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include <benchmark/benchmark.h>
#include <meshoptimizer.h>

#include "bench/bodies.hpp"
#include "bench/peak_memory.hpp"
#include "lod/build.hpp"

namespace {

using namespace springlod;

// 100^3 cells: 1,030,301 nodes, 9,120,300 springs.
const MassSpringModel& million_nodes() {
  static const MassSpringModel base = bench::lattice_cube(100);
  return base;
}

// Builds the chain of base and level 1, with guards, from a moved base. Peak memory is that of the
// whole process: the base, a copy kept here, and all temporary data.
void merge_nodes(benchmark::State& state, lod::Grouping grouping, lod::BorderRule border) {
  const MassSpringModel& base = million_nodes();
  const lod::SimplifyOptions options{.levels = 1,
                                     .grouping = {.grouping = grouping, .border = border}};
  std::uint32_t left = 0;
  if (!bench::reset_peak_memory()) state.SkipWithError("the peak memory counter cannot be reset");
  for (auto _ : state) {
    state.PauseTiming();
    MassSpringModel moved_in = base;
    state.ResumeTiming();
    left = lod::simplify(std::move(moved_in), options).levels[1].model.node_count();
  }
  state.SetItemsProcessed(state.iterations() * base.node_count());
  state.counters["left"] = static_cast<double>(left) / base.node_count();
  state.counters["bytes_per_spring"] =
      static_cast<double>(bench::peak_memory()) / base.spring_count();
}

// The same with a copied base: copying it into the chain is part of the time.
void copy_and_merge_nodes(benchmark::State& state) {
  const MassSpringModel& base = million_nodes();
  for (auto _ : state)
    benchmark::DoNotOptimize(lod::simplify(base, {.levels = 1}).levels[1].model.node_count());
  state.SetItemsProcessed(state.iterations() * base.node_count());
}
BENCHMARK(copy_and_merge_nodes)->Unit(benchmark::kMillisecond);

BENCHMARK_CAPTURE(merge_nodes, standard, lod::Grouping::standard, lod::BorderRule::none)
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(merge_nodes, standard_weak, lod::Grouping::standard, lod::BorderRule::weak)
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(merge_nodes, standard_strong, lod::Grouping::standard, lod::BorderRule::strong)
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(merge_nodes, priority_soft, lod::Grouping::priority_soft, lod::BorderRule::none)
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(merge_nodes, priority_hard, lod::Grouping::priority_hard, lod::BorderRule::none)
    ->Unit(benchmark::kMillisecond);

struct HeightField {
  std::vector<float> positions;  // three per vertex
  std::vector<unsigned> indices;
  std::size_t vertex_count() const { return positions.size() / 3; }
};

// A wavy square of side^2 vertices.
HeightField height_field(unsigned side) {
  HeightField field;
  for (unsigned y = 0; y < side; ++y)
    for (unsigned x = 0; x < side; ++x) {
      const double u = static_cast<double>(x) / side;
      const double v = static_cast<double>(y) / side;
      const double height =
          0.05 * (std::sin(23 * u) * std::cos(17 * v) + std::sin(41 * u + 29 * v));
      for (const double coordinate : {u, v, height})
        field.positions.push_back(static_cast<float>(coordinate));
    }
  for (unsigned y = 0; y + 1 < side; ++y)
    for (unsigned x = 0; x + 1 < side; ++x) {
      const unsigned i = y * side + x;
      for (const unsigned corner : {i, i + 1, i + side, i + side, i + 1, i + side + 1})
        field.indices.push_back(corner);
    }
  return field;
}

// Standard merging leaves this fraction of the nodes of a lattice.
constexpr double kLeft = 0.43;

void meshoptimizer_simplify(benchmark::State& state) {
  constexpr float kAnyError = 1;  // relative to the extent: only the count limits simplification
  const HeightField field = height_field(1015);
  const std::size_t triangles = field.indices.size() / 3;
  const auto target = 3 * static_cast<std::size_t>(kLeft * static_cast<double>(triangles));
  std::vector<unsigned> simplified(field.indices.size());
  std::size_t left = 0;
  for (auto _ : state)
    left = meshopt_simplify(simplified.data(), field.indices.data(), field.indices.size(),
                            field.positions.data(), field.vertex_count(), 3 * sizeof(float), target,
                            kAnyError);
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(field.vertex_count()));
  state.counters["left"] = static_cast<double>(left) / static_cast<double>(field.indices.size());
}
BENCHMARK(meshoptimizer_simplify)->Unit(benchmark::kMillisecond);

}  // namespace

BENCHMARK_MAIN();
