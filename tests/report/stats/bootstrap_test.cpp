#include <cmath>
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

double difference(const Values& base, const Values& other) {
  return mean(other) - mean(base);
}

bool holds(const Interval& interval, double truth) {
  return interval.low <= truth && truth <= interval.high;
}

double width(const Interval& interval) {
  return interval.high - interval.low;
}

/// A level that differs from the base by random effects of the seed and of every run.
StartSample by_seeds(int starts, int seeds, RandomStream& chance) {
  const Values of_seed = normal_sample(chance, seeds);
  StartSample sample{{}, static_cast<std::uint32_t>(seeds)};
  for (int i = 0; i < starts; ++i)
    for (const double effect : of_seed) sample.values.push_back(effect + normal_draw(chance));
  return sample;
}

}  // namespace

TEST_CASE("bootstrap intervals have about their nominal coverage") {
  constexpr int kRepetitions = 500;
  const auto coverage = [&](const auto& sample, double truth, const OneSampleStatistic& statistic) {
    return frequency(kRepetitions, 11, [&](RandomStream& chance) {
      const Bootstrap result =
          bootstrap({sample(chance)}, statistic, {.resamples = 400, .seed = chance.bits()});
      return holds(interval(result, 0.9), truth);
    });
  };
  // Bootstrap intervals of n values are short by a fraction of 1 / (2 n), more for skewed
  // distributions, hence a tolerance of 2 % in addition to the random error.
  const double room = stray(0.9, kRepetitions) + 0.02;
  const auto normal = [](RandomStream& chance) { return normal_sample(chance, 40); };
  const auto exponential = [](RandomStream& chance) { return exponential_sample(chance, 60); };
  CHECK(coverage(normal, 0, mean) == Approx(0.9).margin(room));
  CHECK(coverage(exponential, 1, mean) == Approx(0.9).margin(room));
  CHECK(coverage(exponential, std::log(2.0), [](const Values& v) { return quantile(v, 0.5); }) ==
        Approx(0.9).margin(room));
}

TEST_CASE("the interval of a distance well above the noise contains it") {
  constexpr int kRepetitions = 300;
  const double coverage = frequency(kRepetitions, 12, [](RandomStream& chance) {
    const Values base = normal_sample(chance, 24);
    const Values other = normal_sample(chance, 24, 1);
    const Bootstrap result =
        bootstrap({base}, {other}, wasserstein_distance, {.resamples = 300, .seed = chance.bits()});
    return holds(interval(result, 0.95, IntervalMethod::percentile), 1);
  });
  CHECK(coverage == Approx(0.95).margin(stray(0.95, kRepetitions)));
}

TEST_CASE("BCa follows the skew that percentiles miss") {
  // The mean of a skewed sample is skewed: its interval extends farther upwards.
  RandomStream chance(3);
  const Bootstrap result = bootstrap({exponential_sample(chance, 30)}, mean);
  CHECK(result.acceleration > 0.01);  // about 2 / (6 sqrt 30) for an exponential sample
  CHECK(interval(result).high > interval(result, 0.95, IntervalMethod::percentile).high);
  // The confidence at the end of a one-sided interval is that of the interval.
  for (const double confidence : {0.8, 0.9, 0.95})
    CHECK(confidence_below(result, interval(result, confidence).high) ==
          Approx(0.5 + 0.5 * confidence).margin(0.003));
}

TEST_CASE("a large sample is left out in blocks, to the same acceleration") {
  RandomStream chance(9);
  const Bootstrap result = bootstrap({exponential_sample(chance, 20000)}, mean, {.resamples = 100});
  // Skewness 2 over 6 sqrt(n); random error of 500 blocks about sqrt(6 / 500) / (6 sqrt(500)).
  CHECK(result.acceleration == Approx(2 / (6 * std::sqrt(20000))).margin(4 * 0.0008));
}

TEST_CASE("pairs that go together give a shorter interval than the same values apart") {
  RandomStream chance(4);
  const Values base = normal_sample(chance, 24);
  const Values other = partner_of(base, 0.95, chance);
  const Interval paired = interval(bootstrap({base}, {other}, difference, {.paired = true}));
  const Interval apart = interval(bootstrap({base}, {other}, difference));
  // sqrt(1 - 0.95) = 0.22 of the width
  CHECK(width(paired) < 0.4 * width(apart));
}

TEST_CASE("seeds that differ count as seeds, not as additional runs") {
  constexpr int kRepetitions = 300;
  const auto coverage = [&](SeedDesign design, bool as_table) {
    return frequency(kRepetitions, 5, [&](RandomStream& chance) {
      const Values base = normal_sample(chance, 24);
      StartSample other = by_seeds(24, 8, chance);
      if (!as_table) other.seeds = 1;
      const Bootstrap result = bootstrap(
          {base}, other, difference, {.design = design, .resamples = 200, .seed = chance.bits()});
      return holds(interval(result), 0);
    });
  };
  // Eight seeds are few: with 7 degrees of freedom the coverage decreases from 0.95 to 0.91.
  CHECK(coverage(SeedDesign::crossed, true) > 0.91 - stray(0.91, kRepetitions));
  CHECK(coverage(SeedDesign::crossed, false) < 0.8);
  CHECK(coverage(SeedDesign::nested, true) < 0.8);  // the wrong design for these samples
}

TEST_CASE("nested seeds are drawn with their start") {
  constexpr int kRepetitions = 300;
  const double coverage = frequency(kRepetitions, 6, [](RandomStream& chance) {
    StartSample sample{{}, 4};
    for (int i = 0; i < 24; ++i) {
      const double start = normal_draw(chance);
      for (int k = 0; k < 4; ++k) sample.values.push_back(start + 0.5 * normal_draw(chance));
    }
    const Bootstrap result = bootstrap(
        sample, mean, {.design = SeedDesign::nested, .resamples = 200, .seed = chance.bits()});
    return holds(interval(result, 0.9), 0);
  });
  CHECK(coverage == Approx(0.9).margin(stray(0.9, kRepetitions) + 0.02));
}

TEST_CASE("the same seed resamples the same bits") {
  const StartSample sample{{1, 2, 3, 4, 5, 6, 7, 8}};
  const Bootstrap one = bootstrap(sample, mean, {.resamples = 100, .seed = 5});
  const Bootstrap same = bootstrap(sample, mean, {.resamples = 100, .seed = 5});
  const Bootstrap other = bootstrap(sample, mean, {.resamples = 100, .seed = 6});
  CHECK(one.resampled == same.resampled);
  CHECK(one.resampled != other.resampled);
  // Means of multiples of 1/8 are exact. The expected values come from an independent program.
  CHECK(one.resampled.front() == 2.5);
  CHECK(mean(one.resampled) == Approx(4.56125).epsilon(1e-14));
}

TEST_CASE("samples that cannot be resampled are refused") {
  const StartSample five{{1, 2, 3, 4, 5}};
  const StartSample six{{1, 2, 3, 4, 5, 6}};
  CHECK_THROWS_WITH(bootstrap({{1, 2, 3, 4}}, mean), Contains("at least 5"));
  CHECK_THROWS_WITH(bootstrap(five, six, difference, {.paired = true}), Contains("paired"));
  CHECK_NOTHROW(bootstrap(five, six, difference));
  CHECK_THROWS_WITH(bootstrap(StartSample{{1, 2, 3, 4, 5, 6, 7}, 2}, mean),
                    Contains("do not form a table"));
  CHECK_THROWS_WITH(bootstrap(five, mean, {.resamples = 3}), Contains("resamples"));
  const StartSample flat{{2, 2, 2, 2, 2}};
  CHECK_THROWS_WITH(
      bootstrap(flat, five,
                [](const auto& b, const auto& o) { return difference_over_spread(b, o); }),
      Contains("no spread"));
  CHECK_THROWS_AS(interval(bootstrap(five, mean), 1), InputError);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  CHECK_THROWS_WITH(bootstrap(five, {{1, 2, 3, 4, nan}}, difference), Contains("value 5"));
}

TEST_CASE("a comparison of samples measures all on the same resamples") {
  RandomStream chance(8);
  const Values base = normal_sample(chance, 24, 5, 2);
  const SampleComparison same = compare_samples({base}, {base}, {.resampling = {.paired = true}});
  CHECK(same.difference.value == 0);
  CHECK(width(same.difference.interval) == 0);  // every pair is equal
  CHECK(same.wasserstein.value == 0);
  CHECK_FALSE(same.equivalence.has_value());

  const SampleComparison far = compare_samples({base}, {shifted(base, 3)}, {.margin = 0.5});
  CHECK(far.difference.value == Approx(3));
  CHECK(far.wasserstein.value == Approx(3));
  CHECK(far.difference_over_spread.value == Approx(3 / standard_deviation(base)));
  CHECK(holds(far.energy.interval, far.energy.value));
  CHECK(far.difference.interval.low > 0);
  REQUIRE(far.equivalence.has_value());
  CHECK_FALSE(far.equivalence->equivalent);
}
