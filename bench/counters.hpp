#pragma once

#include <benchmark/benchmark.h>

#include "model/mass_spring.hpp"

namespace springlod::bench {

/// Counters "nodes" and "springs", and "ns_per_spring": the time of an iteration in which each
/// spring is worked out `times` times [ns].
void count_springs(benchmark::State& state, const MassSpringModel& model, double times);

/// Counter `name`: the time of an iteration over `count` [ns].
void count_ns(benchmark::State& state, const char* name, double count);

/// "least": of what others on the machine take from a benchmark's repetitions, the least.
benchmark::internal::Benchmark* keep_least(benchmark::internal::Benchmark* registered);

}  // namespace springlod::bench
