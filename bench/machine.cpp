#include "bench/machine.hpp"

#include <cstdint>
#include <numeric>
#include <vector>

#include <benchmark/benchmark.h>

#include "bench/counters.hpp"

namespace springlod::bench {
namespace {

// Several times the last-level cache of large processors, so that data comes from memory [bytes].
constexpr std::size_t kStreamed = 200'000'000;

std::vector<std::uint64_t> stream() {
  return std::vector<std::uint64_t>(kStreamed / sizeof(std::uint64_t), 1);
}

void read(benchmark::State& state) {
  const std::vector<std::uint64_t> words = stream();
  for (auto _ : state)
    benchmark::DoNotOptimize(std::accumulate(words.begin(), words.end(), std::uint64_t{0}));
  count_ns(state, "ns_per_byte", static_cast<double>(kStreamed));
}

// Every byte counts twice: it is read and written.
void read_write(benchmark::State& state) {
  std::vector<std::uint64_t> words = stream();
  for (auto _ : state) {
    for (std::uint64_t& word : words) ++word;
    benchmark::ClobberMemory();
  }
  count_ns(state, "ns_per_byte", 2 * static_cast<double>(kStreamed));
}

// An integer addition has a latency of one cycle on all supported processors.
void cycle(benchmark::State& state) {
  constexpr int kAdditions = 100'000;
  std::uint64_t sum = 0;
  const auto more = static_cast<std::uint64_t>(state.max_iterations);
  for (auto _ : state)
    for (int i = 0; i < kAdditions; ++i) {
      sum += more;
      asm volatile("" : "+r"(sum));  // dependent additions in a register
    }
  benchmark::DoNotOptimize(sum);
  count_ns(state, "ns_per_cycle", kAdditions);
}

// Throughput of vector instructions, half additions and half multiplications as in the kernels, in
// more independent chains than two units of each kind with a latency of 3 need.
void vectors(benchmark::State& state) {
  using Vector = float __attribute__((vector_size(16)));
  constexpr int kRounds = 10'000;
  constexpr int kChains = 6;  // of each
  const auto one = static_cast<float>(state.threads());
  const Vector factor = {one, one, one, one};
  const auto turn = [&](Vector& sum, Vector& product) {
    sum += factor;
    product *= factor;
    asm volatile("" : "+x"(sum), "+x"(product));  // prevents hoisting and combining
  };
  // No array: all values must be in registers.
  Vector s1{}, s2{}, s3{}, s4{}, s5{}, s6{};
  Vector p1{}, p2{}, p3{}, p4{}, p5{}, p6{};
  for (auto _ : state)
    for (int round = 0; round < kRounds; ++round) {
      turn(s1, p1);
      turn(s2, p2);
      turn(s3, p3);
      turn(s4, p4);
      turn(s5, p5);
      turn(s6, p6);
    }
  Vector all = s1 + s2 + s3 + s4 + s5 + s6 + p1 + p2 + p3 + p4 + p5 + p6;
  benchmark::DoNotOptimize(all);
  count_ns(state, "ns_per_vector", kRounds * 2.0 * kChains);
}

}  // namespace

void register_machine() {
  keep_least(benchmark::RegisterBenchmark("machine/read", read));
  keep_least(benchmark::RegisterBenchmark("machine/read_write", read_write));
  keep_least(benchmark::RegisterBenchmark("machine/cycle", cycle));
  keep_least(benchmark::RegisterBenchmark("machine/vectors", vectors));
}

}  // namespace springlod::bench
