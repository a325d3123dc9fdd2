// Compares our own code with its equivalent in the standard library: the radix sort of a visit
// order with std::sort and std::stable_sort, and the barrier of a team of threads with
// std::barrier. Both sides alternate within one run: counters are ratios of their least times.

#include <algorithm>
#include <barrier>
#include <chrono>
#include <cstdint>
#include <functional>
#include <limits>
#include <random>
#include <string>
#include <thread>
#include <vector>

#include <benchmark/benchmark.h>

#include "lod/grouping/radix_sort.hpp"
#include "sim/fast/step_team.hpp"

namespace {

using springlod::lod::KeyedNode;
using springlod::sim::StepTeam;
using Clock = std::chrono::steady_clock;

template <class Work>
double seconds_of(const Work& work) {
  const auto begin = Clock::now();
  work();
  return std::chrono::duration<double>(Clock::now() - begin).count();
}

struct Side {
  const char* name;
  std::function<double()> time;                            // [s]
  double least = std::numeric_limits<double>::infinity();  // [s]
};

/// The first side is our code; its time is the reported time: "std::sort/ours = 3" means that
/// std::sort takes three times as long. `ns_each`: the least time of ours over `count`.
void take_turns(benchmark::State& state, std::vector<Side> sides, double count) {
  for (auto _ : state)
    for (Side& side : sides) {
      const double seconds = side.time();
      side.least = std::min(side.least, seconds);
      if (&side == &sides[0]) state.SetIterationTime(seconds);
    }
  state.counters["ns_each"] = 1e9 * sides[0].least / count;
  for (std::size_t i = 1; i < sides.size(); ++i)
    state.counters[std::string(sides[i].name) + "/ours"] = sides[i].least / sides[0].least;
}

/// Random keys, like those that determine the order in which nodes are visited.
void sort_nodes(benchmark::State& state) {
  std::mt19937_64 random(1);
  std::vector<KeyedNode> drawn(static_cast<std::size_t>(state.range(0)));
  for (std::size_t i = 0; i < drawn.size(); ++i)
    drawn[i] = {random(), static_cast<std::uint32_t>(i)};
  const auto by_key = [](const KeyedNode& a, const KeyedNode& b) { return a.key < b.key; };
  const auto sorted_by = [&](auto sort) {
    return [&drawn, sort] {
      std::vector<KeyedNode> nodes = drawn;
      return seconds_of([&] { sort(nodes); });
    };
  };
  using Nodes = std::vector<KeyedNode>;
  take_turns(state,
             {{"ours", sorted_by([](Nodes& nodes) { springlod::lod::radix_sort(nodes); })},
              {"std::sort",
               sorted_by([&](Nodes& nodes) { std::sort(nodes.begin(), nodes.end(), by_key); })},
              {"std::stable_sort", sorted_by([&](Nodes& nodes) {
                 std::stable_sort(nodes.begin(), nodes.end(), by_key);
               })}},
             static_cast<double>(state.range(0)));
}
BENCHMARK(sort_nodes)
    ->RangeMultiplier(10)
    ->Range(1000, 1'000'000)
    ->UseManualTime()
    ->Unit(benchmark::kMicrosecond);

/// Two threads that synchronize after every piece of work, as in a step: once without work, and
/// once with some microseconds of work. Few synchronizations per timing, so that some timings are
/// not disturbed by other processes.
void meet(benchmark::State& state) {
  constexpr int kMeetings = 100;
  constexpr std::uint32_t kThreads = 2;
  const auto work_and_meet = [pieces = static_cast<int>(state.range(0))](const auto& wait) {
    wait();  // both are awake
    return seconds_of([&] {
      for (int meeting = 0; meeting < kMeetings; ++meeting) {
        for (int i = 0; i < pieces; ++i) benchmark::DoNotOptimize(i);
        wait();
      }
    });
  };
  const auto ours = [&] {
    double seconds = 0;
    StepTeam(kThreads).run([&](const StepTeam::Member& member) {
      const double own = work_and_meet([&] { member.meet(); });
      if (member.number == 0) seconds = own;
    });
    return seconds;
  };
  const auto standard = [&] {
    std::barrier barrier(kThreads);
    const auto wait = [&] { barrier.arrive_and_wait(); };
    std::thread other([&] { work_and_meet(wait); });
    const double seconds = work_and_meet(wait);
    other.join();
    return seconds;
  };
  take_turns(state, {{"ours", ours}, {"std::barrier", standard}}, kMeetings);
}
BENCHMARK(meet)->Arg(0)->Arg(1000)->Arg(10'000)->UseManualTime()->Unit(benchmark::kMicrosecond);

}  // namespace

BENCHMARK_MAIN();
