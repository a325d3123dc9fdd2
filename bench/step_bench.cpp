// Time per spring of a step with springs, damping, contact, friction and gravity, for a body that
// slightly penetrates the floor: our kernels by size and precision, the naive kernel and Bullet's
// soft bodies, all in one run. Also steps in flight, and what can be read off a body between steps.
// Run by ./dev bench.

#include <array>
#include <string>
#include <vector>

#include <benchmark/benchmark.h>
#include <fmt/format.h>

#include "bench/bullet_bench.hpp"
#include "bench/counters.hpp"
#include "bench/flight_bench.hpp"
#include "bench/look_bench.hpp"
#include "bench/machine.hpp"
#include "bench/naive_step.hpp"
#include "bench/subjects.hpp"
#include "bench/vector_limit.hpp"
#include "sim/fast/fast_leapfrog.hpp"
#include "sim/study/ensemble.hpp"

namespace {

using namespace springlod;
using namespace springlod::bench;

// Number of consecutive steps, as `run` does between two checks of the body.
constexpr std::uint64_t kSteps = 64;

State at_rest(const MassSpringModel& model) {
  return {model.rest, std::vector<Vec3>(model.node_count(), Vec3::Zero()), 0};
}

void step_naively(benchmark::State& state, Subjects& subjects, Shape shape, Size size) {
  const Subject& subject = subjects.subject(shape, size);
  NaiveBody body = naive_body(subject.model);
  for (auto _ : state) naive_step(body, {}, subject.step);
  count_springs(state, subject.model, 1);
}

struct FastStep {
  Shape shape = Shape::merged;
  Size size = Size::small;
  sim::Precision precision = sim::Precision::single_precision;
  Vectors vectors = Vectors::best;
  std::uint32_t threads = 1;
};

void step_fast(benchmark::State& state, Subjects& subjects, const FastStep& of) {
  const VectorLimit limit(of.vectors);
  const Subject& subject = subjects.subject(of.shape, of.size);
  const sim::Scenario scenario = rest_on_floor();
  sim::FastLeapfrog stepper(subject.model, scenario, at_rest(subject.model), subject.step,
                            {.ledger = false,
                             .precision = of.precision,
                             .threads = of.threads,
                             .layout = subjects.layout(of.shape, of.size, of.precision)});
  stepper.prepare();
  for (auto _ : state) stepper.advance(kSteps);
  if (stepper.contacts().empty()) state.SkipWithError("the body left the floor");
  count_springs(state, subject.model, kSteps);
  const Traffic traffic = subjects.traffic(of.shape, of.size, of.precision);
  state.counters["bytes_read"] = traffic.read;
  state.counters["bytes_changed"] = traffic.changed;
  state.SetLabel(sim::vector_target());
}

// Eight starts of a small body; times include the work around the steps.
void run_starts(benchmark::State& state, Subjects& subjects, sim::Precision precision,
                std::uint32_t threads) {
  // Many times the planning time, as in practice; a fiftieth of the paper's scenes. [s]
  constexpr double kDuration = 0.1;
  const Subject& subject = subjects.subject(Shape::merged, Size::small);
  sim::Scenario scenario = rest_on_floor();
  scenario.duration = kDuration;
  const sim::EnsembleOptions options{
      .starts = 8,
      .threads = threads,
      .run = {.sleep = 0, .frame_rate = 0, .ledger = false, .precision = precision}};
  double updates = 0;
  for (auto _ : state) {
    updates = 0;
    for (const sim::EnsembleRun& run : sim::run_ensemble(subject.model, scenario, options))
      updates += static_cast<double>(run.spring_updates);
  }
  count_springs(state, subject.model, updates / subject.model.spring_count());
}

void register_size(Subjects& subjects, Shape shape, Size size) {
  const auto add = [&](const std::string& kernel, auto work) {
    const std::string title = fmt::format("step/{}/{}/{}", name(shape), name(size), kernel);
    keep_least(benchmark::RegisterBenchmark(title.c_str(), work));
  };
  add("naive", [=, &subjects](benchmark::State& s) { step_naively(s, subjects, shape, size); });
  for (const sim::Precision precision :
       {sim::Precision::single_precision, sim::Precision::double_precision}) {
    const FastStep best{shape, size, precision};
    add(name(precision), [=, &subjects](benchmark::State& s) { step_fast(s, subjects, best); });
    if (!has_more_than_avx2()) continue;
    FastStep avx2 = best;
    avx2.vectors = Vectors::avx2;
    add(name(precision) + "/avx2",
        [=, &subjects](benchmark::State& s) { step_fast(s, subjects, avx2); });
  }
}

void register_threads(Subjects& subjects, sim::Precision precision, std::uint32_t threads) {
  const auto add = [&](const std::string& work_name, auto work) {
    const std::string title = fmt::format("{}/{}/threads_{}", work_name, name(precision), threads);
    keep_least(benchmark::RegisterBenchmark(title.c_str(), work)->UseRealTime());
  };
  for (const Shape shape : kShapes) {
    const FastStep of{shape, Size::medium, precision, Vectors::best, threads};
    add(fmt::format("threads/{}/40k", name(shape)),
        [=, &subjects](benchmark::State& s) { step_fast(s, subjects, of); });
  }
  add("ensemble/merged/4k",
      [=, &subjects](benchmark::State& s) { run_starts(s, subjects, precision, threads); });
}

// Interleaved repetitions in one run, so that other load affects all benchmarks alike; the minimum
// counts. Options of the command line follow and take precedence.
std::vector<char*> with_defaults(int argc, char** argv) {
  static std::array<std::string, 4> defaults{
      "--benchmark_enable_random_interleaving=true", "--benchmark_repetitions=5",
      "--benchmark_min_time=0.1", "--benchmark_report_aggregates_only=true"};
  std::vector<char*> arguments{argv[0]};
  for (std::string& argument : defaults) arguments.push_back(argument.data());
  arguments.insert(arguments.end(), argv + 1, argv + argc);
  return arguments;
}

}  // namespace

int main(int argc, char** argv) {
  Subjects subjects;
  register_machine();
  for (const Size size : kSizes)
    for (const Shape shape : kShapes) register_size(subjects, shape, size);
  register_looks(subjects);
  register_flights();
  register_bullet(subjects);
  for (const sim::Precision precision :
       {sim::Precision::single_precision, sim::Precision::double_precision})
    for (const std::uint32_t threads : {1U, 2U}) register_threads(subjects, precision, threads);
  std::vector<char*> arguments = with_defaults(argc, argv);
  argc = static_cast<int>(arguments.size());
  benchmark::Initialize(&argc, arguments.data());
  if (benchmark::ReportUnrecognizedArguments(argc, arguments.data())) return 1;
  benchmark::AddCustomContext("compiler", fmt::format("g++ {}", __VERSION__));
  benchmark::RunSpecifiedBenchmarks();
  benchmark::Shutdown();
  return 0;
}
