// One explicit step of one body: forces, damping, floor with friction, integration. Time a spring.

#include <map>

#include <benchmark/benchmark.h>

#include "bench/bodies.hpp"
#include "bench/naive_step.hpp"
#include "model/stable_step.hpp"
#include "sim/fast/fast_model.hpp"

namespace {

using namespace springlod;
using namespace springlod::bench;

constexpr double kSafety = 0.1;  // far from any limit: what is measured is work, not motion

const MassSpringModel& body(bool merged, std::int64_t nodes) {
  static std::map<std::pair<bool, std::int64_t>, MassSpringModel> made;
  const auto found = made.find({merged, nodes});
  if (found != made.end()) return found->second;
  const int side = static_cast<int>(std::lround(std::cbrt(static_cast<double>(nodes)))) - 1;
  return made[{merged, nodes}] =
             merged ? merged_cube(static_cast<std::uint32_t>(nodes)) : lattice_cube(side);
}

void count_springs(benchmark::State& state, const MassSpringModel& model) {
  state.counters["nodes"] = model.node_count();
  state.counters["ns_per_spring"] = benchmark::Counter(
      static_cast<double>(model.spring_count()) * 1e-9,
      benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
}

template <bool merged>
void naive(benchmark::State& state) {
  const MassSpringModel& model = body(merged, state.range(0));
  NaiveBody naive = naive_body(model);
  const double step = kSafety * stable_step(model);
  for (auto _ : state) naive_step(naive, {}, step);
  count_springs(state, model);
}
BENCHMARK(naive<false>)->Name("lattice/naive_f64")->Arg(4096)->Arg(39304)->Arg(300763);
BENCHMARK(naive<true>)->Name("merged/naive_f64")->Arg(4096)->Arg(40000)->Arg(300000);

template <Precision precision, bool merged>
void fast(benchmark::State& state) {
  const MassSpringModel& model = body(merged, state.range(0));
  const auto laid = make_fast_model(model, precision);
  const auto moving = laid->new_body(false);
  moving->set(model.rest, std::vector<Vec3>(model.node_count(), Vec3::Zero()));
  const double step = kSafety * stable_step(model);
  for (auto _ : state) {
    std::uint32_t next = 0;
    for (std::uint32_t b = 0; b < moving->block_count(); ++b) {
      moving->find_forces(b);
      for (; next < moving->block_count() && moving->needs(next).last <= b; ++next) {
        moving->collect_forces(next);
        moving->move(next, step, step);
      }
    }
  }
  count_springs(state, model);
}
BENCHMARK((fast<Precision::single_precision, false>))
    ->Name("lattice/f32")
    ->Arg(4096)
    ->Arg(39304)
    ->Arg(300763);
BENCHMARK((fast<Precision::double_precision, false>))
    ->Name("lattice/f64")
    ->Arg(4096)
    ->Arg(39304)
    ->Arg(300763);
BENCHMARK((fast<Precision::single_precision, true>))
    ->Name("merged/f32")
    ->Arg(4096)
    ->Arg(40000)
    ->Arg(300000);
BENCHMARK((fast<Precision::double_precision, true>))
    ->Name("merged/f64")
    ->Arg(4096)
    ->Arg(40000)
    ->Arg(300000);

}  // namespace

BENCHMARK_MAIN();
