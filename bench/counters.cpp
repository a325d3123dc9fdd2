#include "bench/counters.hpp"

#include <algorithm>
#include <vector>

namespace springlod::bench {

void count_springs(benchmark::State& state, const MassSpringModel& model, double times) {
  state.counters["nodes"] = model.node_count();
  state.counters["springs"] = model.spring_count();
  count_ns(state, "ns_per_spring", times * model.spring_count());
}

void count_ns(benchmark::State& state, const char* name, double count) {
  constexpr double kNanosecond = 1e-9;  // [s]
  state.counters[name] =
      benchmark::Counter(count * kNanosecond, benchmark::Counter::kIsIterationInvariantRate |
                                                  benchmark::Counter::kInvert);
}

benchmark::internal::Benchmark* keep_least(benchmark::internal::Benchmark* registered) {
  return registered->ComputeStatistics("least", [](const std::vector<double>& times) {
    return *std::min_element(times.begin(), times.end());
  });
}

}  // namespace springlod::bench
