#include <limits>

#include <catch2/catch.hpp>

#include "base/error.hpp"
#include "report/stats.hpp"
#include "tests/report/samples.hpp"

using namespace springlod;
using namespace springlod::report;
using namespace springlod::test;
using Catch::Matchers::Contains;

namespace {

constexpr int kStarts = 24;

/// Fraction of samples, shifted by `apart` from the base's distribution, inside the floor.
double inside(const NoiseFloor& floor, double apart, int repetitions) {
  return frequency(repetitions, 31, [&](RandomStream& chance) {
    const Values base = exponential_sample(chance, kStarts);
    const Values other = shifted(exponential_sample(chance, kStarts), apart);
    return inside_noise_floor(floor, base, other).inside;
  });
}

std::vector<Values> many_sources(int count, int size) {
  RandomStream chance(32);
  std::vector<Values> sources;
  for (int i = 0; i < count; ++i) sources.push_back(exponential_sample(chance, size));
  return sources;
}

}  // namespace

TEST_CASE("95 % of base samples are inside their noise floor, shifted samples are outside") {
  constexpr int kRepetitions = 1000;
  const double chance = stray(0.95, kRepetitions);
  for (const auto distance : {SampleDistance::wasserstein, SampleDistance::energy}) {
    const NoiseFloor drawn =
        noise_floor(many_sources(1, 4000), {.base_size = kStarts, .distance = distance});
    CHECK_FALSE(drawn.with_replacement);
    CHECK(inside(drawn, 0, kRepetitions) == Approx(0.95).margin(chance + 0.01));
    CHECK(inside(drawn, 1.5, kRepetitions) < 0.05);
    // All pairs of 40 samples of that size give the same floor without resampling.
    const NoiseFloor measured = noise_floor(many_sources(40, kStarts), {.distance = distance});
    CHECK(measured.distances.size() == 40 * 39 / 2);
    CHECK(measured.level == Approx(drawn.level).epsilon(0.15));
    CHECK(inside(measured, 0, kRepetitions) == Approx(0.95).margin(chance + 0.02));
  }
}

TEST_CASE("a floor from few base values has less than its nominal coverage, by a known amount") {
  // A new base sample each time, as in practice, so that its randomness counts too.
  const auto rate = [](int size) {
    constexpr int kRepetitions = 300;
    return frequency(kRepetitions, 33, [&](RandomStream& chance) {
      const NoiseFloor floor =
          noise_floor({exponential_sample(chance, size)},
                      {.base_size = kStarts, .resamples = 200, .seed = chance.bits()});
      CHECK(floor.with_replacement == (size < 2 * kStarts));
      const Values base = exponential_sample(chance, kStarts);
      return inside_noise_floor(floor, base, exponential_sample(chance, kStarts)).inside;
    });
  };
  // The floor varies with the estimated spread of the base, which is inaccurate for few skewed
  // values; the header has the figures of many repetitions.
  CHECK(rate(2 * kStarts) == Approx(0.90).margin(stray(0.90, 300)));
  CHECK(rate(kStarts) == Approx(0.87).margin(stray(0.87, 300)));
}

TEST_CASE("a source that differs raises the floor") {
  std::vector<Values> sources = many_sources(2, 100);
  const NoiseFloorOptions options{.base_size = kStarts};
  const double level = noise_floor(sources, options).level;
  sources.push_back(shifted(sources[0], 1));  // as if half the step made a difference
  CHECK(noise_floor(sources, options).level > 1.3 * level);
}

TEST_CASE("a noise floor repeats by seed and falls as samples grow") {
  const auto sources = many_sources(1, 1000);
  const NoiseFloor one = noise_floor(sources, {.base_size = 24, .seed = 1});
  CHECK(one.distances == noise_floor(sources, {.base_size = 24, .seed = 1}).distances);
  CHECK(one.distances != noise_floor(sources, {.base_size = 24, .seed = 2}).distances);
  CHECK(noise_floor(sources, {.base_size = 96}).level < 0.7 * one.level);
  CHECK(noise_floor(sources, {.base_size = 24, .part = 0.5}).level < one.level);
  CHECK(noise_floor(sources, {.base_size = 24, .other_size = 120}).level < one.level);
}

TEST_CASE("the verdict has the distance and its p-value") {
  const NoiseFloor floor = noise_floor(many_sources(1, 1000), {.base_size = 5});
  const Values sample{1, 2, 3, 4, 5};
  const FloorVerdict same = inside_noise_floor(floor, sample, sample);
  CHECK(same.inside);
  CHECK(same.distance == 0);
  CHECK(same.p == 1);
  const FloorVerdict far = inside_noise_floor(floor, sample, shifted(sample, 100));
  CHECK_FALSE(far.inside);
  CHECK(far.distance == Approx(100));
  CHECK(far.p == Approx(1.0 / 2001));
}

TEST_CASE("a noise floor refuses unsuitable sources and samples") {
  const auto sources = many_sources(3, 24);
  CHECK_THROWS_WITH(noise_floor({}), Contains("at least one"));
  CHECK_THROWS_WITH(noise_floor(sources), Contains("3 sources form 3 pairs"));
  CHECK_THROWS_WITH(noise_floor(sources, {.base_size = 30}), Contains("smallest source has 24"));
  CHECK_THROWS_WITH(noise_floor({{1, 2, 3}}), Contains("source 1"));
  CHECK_THROWS_AS(noise_floor(sources, {.base_size = 12, .part = 1}), InputError);
  CHECK_THROWS_AS(noise_floor(sources, {.base_size = 12, .resamples = 5}), InputError);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  CHECK_THROWS_WITH(noise_floor({{1, 2, 3, 4, 5, nan}}), Contains("value 6"));
  const NoiseFloor floor = noise_floor(sources, {.base_size = 12});
  CHECK_THROWS_WITH(inside_noise_floor(floor, sources[0], sources[1]), Contains("sizes 12 and 12"));
}
