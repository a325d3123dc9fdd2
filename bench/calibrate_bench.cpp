// Two levels of a cube, 45 % and 20 % of its nodes, merged and calibrated on all threads. Run by
// ./dev bench, except 100k nodes, which take a quarter of an hour:
//   bench_calibrate --benchmark_filter=100k

#include <benchmark/benchmark.h>

#include "bench/bodies.hpp"
#include "bench/peak_memory.hpp"
#include "lod/build.hpp"

namespace {

using namespace springlod;

// Peak memory is that of the whole process, including the base.
void calibrate_cube(benchmark::State& state, int side) {
  const MassSpringModel base = bench::lattice_cube(side);
  lod::SimplifyOptions options{.keep = {0.45, 0.2},
                               .grouping = {.grouping = lod::Grouping::compact},
                               .calibrate = lod::Calibrate::modes};
  options.calibration.threads = 2;
  if (!bench::reset_peak_memory()) state.SkipWithError("the peak memory counter cannot be reset");
  for (auto _ : state)
    benchmark::DoNotOptimize(lod::simplify(base, options).levels[2].model.node_count());
  constexpr double kGigabyte = 1e9;
  state.counters["nodes"] = base.node_count();
  state.counters["peak_GB"] = static_cast<double>(bench::peak_memory()) / kGigabyte;
}
BENCHMARK_CAPTURE(calibrate_cube, 10k, 21)->Unit(benchmark::kSecond)->UseRealTime();
BENCHMARK_CAPTURE(calibrate_cube, 100k, 46)->Unit(benchmark::kSecond)->UseRealTime();

}  // namespace

BENCHMARK_MAIN();
