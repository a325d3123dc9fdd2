// One explicit step of one body: forces, damping, floor with friction, integration. Time a spring.

#include <map>

#include <benchmark/benchmark.h>

#include "bench/bodies.hpp"
#include "bench/naive_step.hpp"
#include "model/stable_step.hpp"
#include "sim/fast/quad_kernel.hpp"
#include "sim/fast/quad_layout.hpp"
#include "sim/fast/row_state.hpp"

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

template <class Real>
void move(SpringBlocks<Real>& laid, const Floor& floor, Real step) {
  const auto kappa = static_cast<Real>(floor.stiffness);
  const auto mu = static_cast<Real>(floor.friction);
  const auto fall = static_cast<Real>(floor.gravity) * step;
  for (SpringBlock<Real>& block : laid.blocks)
    for (std::uint32_t i = 0; i < block.own; ++i) {
      NodeRecord<Real>& r = block.records[i];
      NodeForce<Real> f = block.forces[i];
      block.forces[i] = {};
      for (std::uint32_t c = block.copies_first[i]; c < block.copies_first[i + 1]; ++c) {
        NodeForce<Real>& copy = laid.blocks[block.copies[c].block].forces[block.copies[c].index];
        for (int k = 0; k < 4; ++k) f.f[k] += copy.f[k];
        copy = {};
      }
      const Real factor = r.inverse_mass * step;
      for (int k = 0; k < 3; ++k) r.v[k] += factor * f.f[k];
      r.v[2] -= fall;
      if (r.x[2] < 0) {
        const Real push = kappa * r.contact_area * -r.x[2];
        r.v[2] += factor * push;
        const Real slip = std::sqrt(r.v[0] * r.v[0] + r.v[1] * r.v[1]);
        const Real most = mu * push * factor;
        const Real keep = slip > most ? 1 - most / slip : 0;
        r.v[0] *= keep;
        r.v[1] *= keep;
      }
      for (int k = 0; k < 3; ++k) r.x[k] += step * r.v[k];
    }
}

template <class Real, bool merged>
void blocks(benchmark::State& state) {
  const MassSpringModel& model = body(merged, state.range(0));
  SpringBlocks<Real> laid = make_spring_blocks<Real>(model);
  const auto step = static_cast<Real>(kSafety * stable_step(model));
  for (auto _ : state) {
    for (SpringBlock<Real>& block : laid.blocks) {
      for (std::size_t h = 0; h < block.halo.size(); ++h)
        block.records[block.own + h] =
            laid.blocks[block.halo[h].block].records[block.halo[h].index];
      add_block_forces(block);
    }
    move<Real>(laid, {}, step);
  }
  count_springs(state, model);
}
BENCHMARK((blocks<float, false>))->Name("lattice/blocks_f32")->Arg(4096)->Arg(39304)->Arg(300763);
BENCHMARK((blocks<float, true>))->Name("merged/blocks_f32")->Arg(4096)->Arg(40000)->Arg(300000);

template <class Real, bool merged>
void rows(benchmark::State& state) {
  const MassSpringModel& model = body(merged, state.range(0));
  const RowLayout<Real> layout = make_row_layout<Real>(model);
  RowState<Real> moving(layout);
  for (std::uint32_t p = 0; p < layout.node.size(); ++p)
    for (int k = 0; k < 3; ++k) moving.x[k][p] = static_cast<Real>(model.rest[layout.node[p]][k]);
  const double step = kSafety * stable_step(model);
  for (auto _ : state) {
    for (std::uint32_t b = 0; b < layout.blocks.size(); ++b) find_row_forces(layout, b, moving);
    for (std::uint32_t b = 0; b < layout.blocks.size(); ++b)
      move_rows(layout, b, step, step, moving);
  }
  count_springs(state, model);
  state.counters["fill"] = double(model.spring_count()) / double(layout.rows.size());
  state.counters["palette"] = double(layout.properties.size());
}
BENCHMARK((rows<float, false>))->Name("lattice/rows_f32")->Arg(4096)->Arg(39304)->Arg(300763);
BENCHMARK((rows<double, false>))->Name("lattice/rows_f64")->Arg(4096)->Arg(39304)->Arg(300763);
BENCHMARK((rows<float, true>))->Name("merged/rows_f32")->Arg(4096);

}  // namespace

BENCHMARK_MAIN();
