#pragma once

#include <benchmark/benchmark.h>

#include "model/mass_spring.hpp"

namespace springlod::bench {

/// Sets the counters "nodes", "springs" and "ns_per_spring": time per spring of an iteration that
/// processes each spring `times` times [ns].
void count_springs(benchmark::State& state, const MassSpringModel& model, double times);

/// Sets the counter `name`: time of an iteration divided by `count` [ns].
void count_ns(benchmark::State& state, const char* name, double count);

/// Reports the minimum of a benchmark's repetitions ("least"), which is least affected by other
/// load.
benchmark::internal::Benchmark* keep_least(benchmark::internal::Benchmark* registered);

}  // namespace springlod::bench
