#include <cmath>

#include <boost/math/distributions/students_t.hpp>
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
constexpr double kCorrelation = 0.95;  // of pairs

/// Rate of "equivalent" for normal samples whose means are `apart` spreads apart.
double said(double apart, const EquivalenceOptions& options, int repetitions) {
  return frequency(repetitions, 21, [&](RandomStream& chance) {
    const Values base = normal_sample(chance, kStarts);
    const Values other =
        options.paired ? partner_of(base, kCorrelation, chance) : normal_sample(chance, kStarts);
    return test_equivalence({base}, {shifted(other, apart)}, options).equivalent;
  });
}

}  // namespace

TEST_CASE("with a known spread the test equals two one-sided t-tests") {
  const Values base{1, 2, 3, 4, 5, 6};
  const Values other{1.5, 2, 3.5, 4, 5.5, 6};
  const EquivalenceOptions options{.margin = 0.5, .spread = 2, .paired = true};
  const Equivalence paired = test_equivalence({base}, {other}, options);
  // Differences .5 0 .5 0 .5 0: mean .25, standard error sqrt(.075 / 6); the margin is 1.
  const double error = std::sqrt(0.075 / 6);
  const boost::math::students_t student(5);
  CHECK(paired.difference == Approx(0.25));
  CHECK(paired.p_lower == Approx(cdf(complement(student, 1.25 / error))));
  CHECK(paired.p_higher == Approx(cdf(complement(student, 0.75 / error))));
  CHECK(paired.equivalent);
  const Equivalence apart = test_equivalence({base}, {other}, {.margin = 0.5, .spread = 2});
  CHECK(apart.p() > 0.1);
  CHECK_FALSE(apart.equivalent);
}

TEST_CASE("means a margin apart are declared equivalent at the rate alpha") {
  constexpr int kRepetitions = 3000;
  const double chance = stray(0.05, kRepetitions);
  const EquivalenceOptions apart{.margin = 1};
  CHECK(said(1, apart, kRepetitions) == Approx(0.05).margin(chance + 0.005));
  CHECK(said(-1, apart, kRepetitions) == Approx(0.05).margin(chance + 0.005));
  const EquivalenceOptions paired{.margin = 0.5, .paired = true};
  CHECK(said(0.5, paired, kRepetitions) == Approx(0.05).margin(chance + 0.005));
  // At twice the margin, the test never reports equivalence.
  CHECK(said(2, apart, kRepetitions) == 0);
}

TEST_CASE("equal means are declared equivalent, with far fewer starts if paired") {
  constexpr int kRepetitions = 500;
  CHECK(said(0, {.margin = 1}, kRepetitions) > 0.8);
  CHECK(said(0, {.margin = 0.5}, kRepetitions) < 0.15);  // 24 starts are too few
  CHECK(said(0, {.margin = 0.5, .paired = true}, kRepetitions) > 0.99);
}

TEST_CASE("a margin taken as exact although it was estimated would be called the same too often") {
  const double too_often = frequency(2000, 22, [](RandomStream& chance) {
    const Values base = normal_sample(chance, kStarts);
    const Values other = shifted(partner_of(base, kCorrelation, chance), 1);
    const EquivalenceOptions exact{.margin = 1, .spread = standard_deviation(base), .paired = true};
    return test_equivalence({base}, {other}, exact).equivalent;
  });
  CHECK(too_often > 0.15);
}

TEST_CASE("seeds that differ make the test more conservative") {
  constexpr int kRepetitions = 2000;
  constexpr int kSeeds = 5;
  const auto rate = [&](double apart, SeedDesign design) {
    return frequency(kRepetitions, 23, [&](RandomStream& chance) {
      const Values base = normal_sample(chance, kStarts);
      const Values of_seed = normal_sample(chance, kSeeds, 0, 0.4);
      StartSample other{{}, kSeeds};
      for (const double start : partner_of(base, kCorrelation, chance))
        for (const double seed : of_seed) other.values.push_back(start + seed + apart);
      return test_equivalence({base}, other, {.margin = 1, .paired = true, .design = design})
          .equivalent;
    });
  };
  CHECK(rate(1, SeedDesign::crossed) == Approx(0.05).margin(stray(0.05, kRepetitions) + 0.01));
  CHECK(rate(0, SeedDesign::crossed) > 0.9);
  CHECK(rate(1, SeedDesign::nested) > 0.1);  // as if seeds had no random effect
}

TEST_CASE("the bootstrap form agrees with the test by Student's distribution") {
  RandomStream chance(24);
  const Values base = normal_sample(chance, 100);
  const Values other = shifted(partner_of(base, kCorrelation, chance), 0.4);
  for (const double margin : {0.3, 0.4, 0.5}) {
    const EquivalenceOptions options{.margin = margin, .paired = true};
    const Equivalence student = test_equivalence({base}, {other}, options);
    const Equivalence resampled = bootstrap_equivalence({base}, {other}, options, {.paired = true});
    CHECK(resampled.p() == Approx(student.p()).margin(0.05));
    CHECK(resampled.difference == student.difference);
  }
}

TEST_CASE("a margin must be stated and the base must have a spread") {
  const StartSample sample{{1, 2, 3, 4, 5}};
  const StartSample flat{{1, 1, 1, 1, 1}};
  CHECK_THROWS_WITH(test_equivalence(sample, sample, {}), Contains("must be above 0"));
  CHECK_THROWS_WITH(test_equivalence(flat, sample, {.margin = 1}), Contains("jitter"));
  CHECK_NOTHROW(test_equivalence(flat, sample, {.margin = 1, .spread = 2}));
  CHECK_THROWS_AS(test_equivalence(sample, sample, {.margin = 1, .alpha = 0.7}), InputError);
  CHECK_THROWS_AS(test_equivalence(sample, sample, {.margin = 1, .spread = 0}), InputError);
  CHECK_THROWS_AS(test_equivalence(sample, {{1, 2, 3, 4, 5, 6}}, {.margin = 1, .paired = true}),
                  InputError);
}
