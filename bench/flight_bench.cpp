#include "bench/flight_bench.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <functional>
#include <limits>
#include <memory>
#include <string>
#include <vector>

#include <benchmark/benchmark.h>
#include <fmt/format.h>

#include "bench/counters.hpp"
#include "bench/subjects.hpp"
#include "lod/build.hpp"
#include "sim/fast/step_time.hpp"
#include "sim/run.hpp"
#include "voxelize/lattice/lattice.hpp"

namespace springlod::bench {
namespace {

// Step, far below the stable one of all bodies [s], and number of steps of a short run. `run`
// checks the body every so many steps.
constexpr double kStep = 1e-6;
constexpr std::uint64_t kShort = 64;

// A measurement goes through about as many springs [springs]: some milliseconds.
constexpr std::uint64_t kSprings = 1'000'000;

/// A body of cells of 1 cm: those of the box of `size` cells for which `material` is not below 0.
struct Body {
  std::string name;
  std::array<int, 3> size;
  std::function<int(double x, double y, double z)> material;  // of the middle of a cell [cells]
};

MassSpringModel lattice_of(const Body& body) {
  constexpr double kCell = 0.01;  // [m]
  voxelize::MaterialGrid grid;
  grid.cell = kCell;
  grid.materials = {Material{.name = "rubber", .damping = 0.0002},
                    Material{.name = "rod", .young = 1e7, .damping = 0.0001}};
  for (int z = 0; z < body.size[2]; ++z)
    for (int y = 0; y < body.size[1]; ++y)
      for (int x = 0; x < body.size[0]; ++x) {
        const int material = body.material(x + 0.5, y + 0.5, z + 0.5);
        if (material < 0) continue;
        grid.cells.push_back({x, y, z});
        grid.material.push_back(static_cast<std::uint16_t>(material));
      }
  return voxelize::build_lattice(grid).model;
}

int rubber(double, double, double) {
  return 0;
}

Body block(std::array<int, 3> size) {
  return {fmt::format("block_{}x{}x{}", size[0], size[1], size[2]), size, rubber};
}

Body sphere(int size) {
  const double radius = size / 2.0;
  return {
      fmt::format("sphere_{}", size), {size, size, size}, [radius](double x, double y, double z) {
        const Vec3 from_center = Vec3(x, y, z) - Vec3::Constant(radius);
        return from_center.norm() < radius ? 0 : -1;
      }};
}

/// Two spheres of `size` cells, joined by a rod.
Body dumbbell(int size) {
  const double radius = size / 2.0;
  const int length = 3 * size;
  return {fmt::format("dumbbell_{}", size),
          {size, size, length},
          [radius, length](double x, double y, double z) {
            const double to_axis = std::hypot(x - radius, y - radius);
            const double to_center = std::min(std::abs(z - radius), std::abs(length - radius - z));
            if (std::hypot(to_axis, to_center) < radius) return 0;
            return to_axis < 0.4 * radius && z > radius && z < length - radius ? 1 : -1;
          }};
}

/// Two stiff rods, joined by rubber.
Body rods(int width, int length) {
  return {fmt::format("rods_{}x{}", width, length),
          {width, width, length},
          [length](double, double, double z) { return std::abs(z - 0.5 * length) < 3 ? 0 : 1; }};
}

/// Levels of about 45 % and 20 % of the nodes.
LodChain levels_of(const Body& body) {
  return lod::simplify(lattice_of(body),
                       {.levels = 2, .grouping = {.grouping = lod::Grouping::compact}});
}

/// Processor time of the steps of a run [s].
double run_for(const MassSpringModel& model, std::uint64_t steps, const sim::RunOptions& options,
               const sim::RunPlan& plan) {
  sim::Scenario flight;
  flight.start.spin = {1, 2, 3};
  flight.duration = static_cast<double>(steps) * kStep;
  return sim::run(model, flight, sim::initial_state(model, flight.start), options, plan)
      .processor_seconds;
}

// The difference of the least times of long and short runs, without what a run does once.
void fly(benchmark::State& state, const MassSpringModel& model, sim::Precision precision) {
  const sim::RunOptions options{
      .step = kStep, .sleep = 0, .frame_rate = 0, .ledger = false, .precision = precision};
  sim::Scenario flight;
  flight.duration = 1;
  const sim::RunPlan plan = sim::plan_runs(model, flight, options);
  const std::uint64_t steps = kShort * (1 + kSprings / kShort / model.spring_count());
  double least_long = std::numeric_limits<double>::infinity();
  double least_short = std::numeric_limits<double>::infinity();
  for (auto _ : state) {
    least_long = std::min(least_long, run_for(model, kShort + steps, options, plan));
    least_short = std::min(least_short, run_for(model, kShort, options, plan));
  }
  state.counters["ns_per_step"] = 1e9 * (least_long - least_short) / static_cast<double>(steps);
  const sim::StepWork work = sim::step_work(model, precision);
  state.counters["nodes"] = model.node_count();
  state.counters["springs"] = model.spring_count();
  state.counters["work_nodes"] = static_cast<double>(work.nodes);
  state.counters["work_eights"] = static_cast<double>(work.eights);
  state.counters["predicted_ns"] = 1e9 * sim::step_time(model, precision).seconds;
  state.SetLabel(to_string(work.kernel));
}

}  // namespace

void register_flights() {
  const std::vector<Body> bodies{block({4, 4, 4}),    block({8, 8, 8}),  block({12, 12, 12}),
                                 block({24, 24, 24}), block({3, 3, 12}), block({5, 5, 40}),
                                 block({20, 20, 3}),  rods(4, 23),       rods(8, 46),
                                 sphere(8),           sphere(12),        sphere(20),
                                 dumbbell(6),         dumbbell(12)};
  for (const Body& body : bodies) {
    const auto chain = std::make_shared<const LodChain>(levels_of(body));
    for (std::size_t level = 0; level < chain->levels.size(); ++level)
      for (const sim::Precision precision :
           {sim::Precision::single_precision, sim::Precision::double_precision}) {
        const std::string title = fmt::format("flight/{}/{}/{}", body.name, level, name(precision));
        keep_least(benchmark::RegisterBenchmark(title.c_str(), [=](benchmark::State& state) {
          fly(state, chain->levels[level].model, precision);
        }));
      }
  }
}

}  // namespace springlod::bench
