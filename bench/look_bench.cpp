#include "bench/look_bench.hpp"

#include <algorithm>
#include <chrono>
#include <limits>
#include <string>
#include <vector>

#include <benchmark/benchmark.h>
#include <fmt/format.h>

#include "bench/counters.hpp"
#include "sim/fast/fast_body.hpp"

namespace springlod::bench {
namespace {

/// The least time of a piece of work.
class LeastTime {
 public:
  template <class Work>
  void measure(const Work& work) {
    const auto start = std::chrono::steady_clock::now();
    work();
    least_ = std::min(
        least_, std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
  }
  double least() const { return least_; }  // [s]

 private:
  double least_ = std::numeric_limits<double>::infinity();
};

void step(sim::FastBody& body, double length) {
  for (std::uint32_t b = 0; b < body.block_count(); ++b) body.find_forces(b);
  for (std::uint32_t b = 0; b < body.block_count(); ++b) {
    body.collect_forces(b);
    body.move(b, length, length);
  }
}

void look(benchmark::State& state, Subjects& subjects, Shape shape, Size size,
          sim::Precision precision) {
  const Subject& subject = subjects.subject(shape, size);
  const auto body = subjects.layout(shape, size, precision)->new_body(false);
  const std::vector<Vec3> v(subject.model.node_count(), Vec3::Zero());
  for (std::uint32_t b = 0; b < body->block_count(); ++b) body->set(b, {}, subject.model.rest, v);
  LeastTime plain;
  LeastTime spinning;
  LeastTime corners;
  LeastTime strain;
  std::vector<std::uint32_t> found;
  for (auto _ : state) {
    body->set_rigid_motion({});
    plain.measure([&] { step(*body, subject.step); });
    body->set_rigid_motion({.spin = {1, 2, 3}});
    spinning.measure([&] { step(*body, subject.step); });
    const sim::CornerLook look{.travel = std::numeric_limits<double>::infinity(),
                               .farthest = body->farthest_coordinate()};  // all are due
    corners.measure([&] {
      for (std::uint32_t b = 0; b < body->block_count(); ++b)
        benchmark::DoNotOptimize(body->find_corners(b, look, found));
    });
    strain.measure([&] {
      for (std::uint32_t b = 0; b < body->block_count(); ++b)
        benchmark::DoNotOptimize(body->largest_strain(b));
    });
  }
  if (!found.empty()) state.SkipWithError("a corner of a body at rest is small");
  state.counters["step_us"] = 1e6 * plain.least();
  state.counters["departure"] = spinning.least() / plain.least() - 1;
  state.counters["corners"] = corners.least() / plain.least();
  state.counters["strain"] = strain.least() / plain.least();
}

}  // namespace

void register_looks(Subjects& subjects) {
  for (const Size size : kSizes)
    for (const Shape shape : kShapes)
      for (const sim::Precision precision :
           {sim::Precision::single_precision, sim::Precision::double_precision}) {
        const std::string title =
            fmt::format("look/{}/{}/{}", name(shape), name(size), name(precision));
        keep_least(benchmark::RegisterBenchmark(title.c_str(), [=, &subjects](benchmark::State& s) {
          look(s, subjects, shape, size, precision);
        }));
      }
}

}  // namespace springlod::bench
