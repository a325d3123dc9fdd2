#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <string_view>
#include <tuple>
#include <vector>

#include "base/choice.hpp"
#include "base/option.hpp"
#include "base/progress.hpp"

// Statistics of samples of runs: the public header of stats/, which depends only on base/.
namespace springlod::report {

// One or two samples (statistics.cpp).

// A sample is a list of values of one quantity, in any order; results have its unit unless noted.
// All functions throw InputError for values that are not finite and for too few values.

/// Throws InputError unless `sample` has at least `least` values and all are finite. `what` names
/// the sample in the message: "base".
void require_sample(const std::vector<double>& sample, std::size_t least, std::string_view what);

/// At least one value.
double mean(const std::vector<double>& sample);

/// With the divisor n - 1 (unbiased variance). At least two values.
double standard_deviation(const std::vector<double>& sample);

/// Quantile of order `part` (0..1), interpolated linearly (Hyndman and Fan 1996, type 7; the
/// default of R and NumPy). Needs at least one value.
double quantile(std::vector<double> sample, double part);
/// The same for a sorted sample; the order is not checked.
double sorted_quantile(const std::vector<double>& rising, double part);

/// Glass's delta [1]: mean of `other` minus mean of `base`, divided by the standard deviation of
/// `base`, or by `spread` if given. If all values of the base are equal, it is infinite, or 0 for
/// equal means. Needs at least two values in `base`.
double difference_over_spread(const std::vector<double>& base, const std::vector<double>& other,
                              std::optional<double> spread = {});

/// 1-Wasserstein (earth mover's) distance of two samples: the integral of |F - G| of their
/// empirical distribution functions, exact for any sizes. It is the mean displacement of values
/// that turns one sample into the other.
double wasserstein_distance(std::vector<double> base, std::vector<double> other);

/// Energy distance 2 E|X - Y| - E|X - X'| - E|Y - Y'| without square root (Szekely and Rizzo 2013,
/// "Energy statistics: a class of statistics based on distances"), in the unit of the values. It is
/// the V-statistic, which includes pairs of a value with itself: never negative, and 0 only for
/// equal empirical distributions. Computed as 2 times the integral of (F - G)^2.
double energy_distance(std::vector<double> base, std::vector<double> other);

// Samples by start and seed (start_sample.cpp).

/// Values of one quantity by start, or by start and simplification seed:
/// values[start * seeds + seed].
struct StartSample {
  std::vector<double> values;
  std::uint32_t seeds = 1;
  std::size_t starts() const { return values.size() / seeds; }
};

/// Relation between the seeds and the starts of a StartSample.
enum class SeedDesign {
  crossed,  ///< the same seeds for every start: one chain per seed, run from every start
  nested    ///< different seeds for every start
};

inline constexpr Choice<SeedDesign> kSeedDesigns[] = {
    {SeedDesign::crossed, "crossed", "the same seeds in every start: one chain per seed"},
    {SeedDesign::nested, "nested", "different seeds in every start"}};
constexpr ChoiceTable<Choice<SeedDesign>> choices(SeedDesign) {
  return {"seeds", kSeedDesigns};
}

/// Four starts have only 35 different resamples, too few for tail probabilities.
constexpr std::size_t kLeastStarts = 5;

/// Throws InputError for fewer than kLeastStarts starts, values that are not finite, and incomplete
/// tables. `what` names the sample in the message: "base".
void require_starts(const StartSample& sample, std::string_view what);
/// Throws InputError unless both have the same number of starts.
void require_pairs(const StartSample& base, const StartSample& other);

// Resampling (bootstrap.cpp).

constexpr std::uint32_t kFewestResamples = 100;
constexpr std::uint32_t kMostResamples = 1'000'000;  // 8 MB of results

struct BootstrapOptions {
  /// Start i of both samples is the same start: both values are drawn together.
  bool paired = false;
  SeedDesign design = SeedDesign::crossed;
  std::uint32_t resamples = 2000;  ///< kFewestResamples .. kMostResamples
  std::uint64_t seed = 1;
  Progress* progress = nullptr;
};
constexpr auto option_rows(const BootstrapOptions*) {
  return std::tuple(
      option("resamples", &BootstrapOptions::resamples, "number of resamples")
          .within(kFewestResamples, kMostResamples),
      option("seed", &BootstrapOptions::seed, "seed of the resampling"),
      option("seeds", &BootstrapOptions::design,
             "whether the simplification seeds are the same in every start"),
      option("paired", &BootstrapOptions::paired,
             "whether start i of both samples is the same start, as in one comparison"));
}

using OneSampleStatistic = std::function<double(const std::vector<double>&)>;
using TwoSampleStatistic =
    std::function<double(const std::vector<double>& base, const std::vector<double>& other)>;

/// Bootstrap distribution of a statistic.
struct Bootstrap {
  double estimate = 0;            ///< the statistic of the data
  std::vector<double> resampled;  ///< the statistic of each resample, ascending
  double bias = 0;                ///< z0 of BCa
  double acceleration = 0;        ///< a of BCa, by the jackknife over starts and seeds
};

/// Resamples starts with replacement.
/// - Crossed seeds: starts and seeds are drawn independently (pigeonhole bootstrap, Owen 2007),
///   which is conservative if neither has an effect. One seed fewer is drawn than there are, which
///   makes the variance of a mean unbiased (McCarthy and Snowden 1985). Few seeds remain a
///   limitation: with 5 seeds that differ, 95 % intervals have a coverage of 89 %.
/// - Nested seeds: a start is drawn with all its seeds, which includes the variance of both;
///   drawing seeds as well would count their variance twice (Davison and Hinkley 1997, 3.8).
/// Deterministic for a seed. The draws depend only on sizes, design and seed, so that several
/// statistics use the same resamples. Throws InputError as require_starts and require_pairs do, for
/// a number of resamples out of range, and for a statistic that is not a number.
Bootstrap bootstrap(const StartSample& sample, const OneSampleStatistic& statistic,
                    const BootstrapOptions& options = {});
Bootstrap bootstrap(const StartSample& base, const StartSample& other,
                    const TwoSampleStatistic& statistic, const BootstrapOptions& options = {});

struct Interval {
  double low = 0;
  double high = 0;
};

enum class IntervalMethod {
  /// Bias-corrected and accelerated (Efron 1987; Efron and Tibshirani 1993, 14.3): for means,
  /// differences, quantiles. Second-order accurate for smooth statistics, also of skewed samples.
  bca,
  /// For distances, which are not smooth at 0, where the bias correction of BCa fails. Example: two
  /// normal samples of 24 values, means half a standard deviation apart; 95 % intervals of the
  /// Wasserstein distance have a coverage of 96 % by percentile and 78 % by BCa. For samples of one
  /// distribution no such interval contains the true distance, 0; use the noise floor.
  percentile
};

/// Confidence interval with confidence level `confidence` (0..1, such as 0.95).
Interval interval(const Bootstrap& result, double confidence = 0.95,
                  IntervalMethod method = IntervalMethod::bca);

/// Confidence that the true value is below `value`: the level of the one-sided BCa interval that
/// ends at `value`. 1 minus it is the p-value of the null hypothesis "at least `value`".
double confidence_below(const Bootstrap& result, double value);

// Tests of equivalence (equivalence.cpp).

struct EquivalenceOptions {
  /// Largest difference of the means that counts as equivalent, in standard deviations of the base;
  /// > 0. It has no default: the application decides.
  double margin = 0;
  /// Standard deviation of the base [unit of the values], if known from a larger sample. Default:
  /// that of the given base; the test then accounts for its uncertainty.
  std::optional<double> spread = {};
  bool paired = false;
  SeedDesign design = SeedDesign::crossed;
  double alpha = 0.05;  ///< significance level: rate of "equivalent" for means a margin apart
};

/// Result of two one-sided tests (TOST, Schuirmann 1987): equivalence is shown if both null
/// hypotheses, "lower by the margin or more" and "higher by the margin or more", are rejected. If
/// not, the test is inconclusive.
struct Equivalence {
  double difference = 0;  ///< mean of the other minus mean of the base [unit of the values]
  double spread = 0;      ///< unit of the margin [unit of the values]
  double p_lower = 1;     ///< of the null hypothesis "lower by the margin or more"
  double p_higher = 1;    ///< of the null hypothesis "higher by the margin or more"
  bool equivalent = false;
  double p() const { return p_lower > p_higher ? p_lower : p_higher; }
};

/// TOST with Student's t distribution and Welch-Satterthwaite degrees of freedom. `paired`: start i
/// of both samples is the same start, and the test uses the differences. If the spread is estimated
/// from the base, the uncertainty of the margin is added by the delta method. (An exact margin
/// would make the test too liberal: 23 % instead of 5 % at 24 pairs with correlation 0.95 and
/// margin 1.) Crossed seeds add the variance between their means; the residual variance counts
/// twice, which is conservative. Throws InputError for fewer than 5 starts, pairs of different
/// length, a margin or alpha out of range, and a base without spread.
Equivalence test_equivalence(const StartSample& base, const StartSample& other,
                             const EquivalenceOptions& options);

/// TOST with the BCa bootstrap of difference_over_spread, for values far from normal. `resampling`
/// replaces the options of the same name. At 24 starts its actual significance level is 6 to 8 %
/// for a nominal 5 %.
Equivalence bootstrap_equivalence(const StartSample& base, const StartSample& other,
                                  const EquivalenceOptions& options,
                                  const BootstrapOptions& resampling);

// Two samples compared (sample_comparison.cpp).

/// How means are tested for equivalence.
enum class MeanTest {
  student,    ///< test_equivalence
  bootstrap,  ///< bootstrap_equivalence
};

inline constexpr Choice<MeanTest> kMeanTests[] = {
    {MeanTest::student, "student", "Student's t"},
    {MeanTest::bootstrap, "bootstrap", "BCa bootstrap, for values far from normal"}};
constexpr ChoiceTable<Choice<MeanTest>> choices(MeanTest) {
  return {"test", kMeanTests};
}

struct SampleComparisonOptions {
  BootstrapOptions resampling = {};   ///< pairing and design also apply to the test
  double confidence = 0.95;           ///< of the intervals; the test is at 1 - confidence
  std::optional<double> margin = {};  ///< of the equivalence test; none: no test
  std::optional<double> spread = {};  ///< see EquivalenceOptions
  MeanTest test = MeanTest::student;
};
constexpr auto option_rows(const SampleComparisonOptions*) {
  return std::tuple(
      option("confidence", &SampleComparisonOptions::confidence,
             "confidence level of the intervals")
          .within(0.5, 1),
      nested<SampleComparisonOptions>(&SampleComparisonOptions::resampling),
      option("margin", &SampleComparisonOptions::margin,
             "largest difference of the means that counts as equivalent, in standard deviations "
             "of the base; tested at 1 - confidence")
          .within(1e-9, 1e9)
          .by_default("no test"),
      option("spread", &SampleComparisonOptions::spread,
             "standard deviation of the base, if known from a larger sample")
          .by_default("estimated from the base"),
      option("test", &SampleComparisonOptions::test, "test of the means"));
}

/// A value and its confidence interval.
struct Measured {
  double value = 0;
  Interval interval;
};

/// Differences and distances of `other` from `base`.
struct SampleComparison {
  Measured difference;              ///< of the means, other minus base [unit of the values]
  Measured difference_over_spread;  ///< [1]
  Measured wasserstein;             ///< 1-Wasserstein distance [unit of the values]
  Measured energy;                  ///< energy distance, without a root [unit of the values]
  std::optional<Equivalence> equivalence;
};

/// All use the same resamples: BCa intervals for the differences, percentile intervals for the
/// distances. Throws InputError as bootstrap and test_equivalence do.
SampleComparison compare_samples(const StartSample& base, const StartSample& other,
                                 const SampleComparisonOptions& options = {});

// The noise floor (noise_floor.cpp).

enum class SampleDistance { wasserstein, energy };

inline constexpr Choice<SampleDistance> kSampleDistances[] = {
    {SampleDistance::wasserstein, "wasserstein", "1-Wasserstein distance"},
    {SampleDistance::energy, "energy", "energy distance, without a root"}};
constexpr ChoiceTable<Choice<SampleDistance>> choices(SampleDistance) {
  return {"distance", kSampleDistances};
}

/// wasserstein_distance or energy_distance.
double distance_between(const std::vector<double>& base, const std::vector<double>& other,
                        SampleDistance distance);

struct NoiseFloorOptions {
  /// Sizes of the two samples of each distance. They must equal the sizes of the samples to be
  /// judged, as distances decrease with sample size. 0: half of the only source, or the smallest of
  /// several sources.
  std::uint32_t base_size = 0;
  std::uint32_t other_size = 0;  ///< 0: as base_size
  SampleDistance distance = SampleDistance::wasserstein;
  double part = 0.95;  ///< order of the quantile
  /// Distances drawn, kFewestResamples to kMostResamples.
  std::uint32_t resamples = 2000;
  std::uint64_t seed = 1;
  Progress* progress = nullptr;
};
constexpr auto option_rows(const NoiseFloorOptions*) {
  return std::tuple(
      option("size", &NoiseFloorOptions::base_size, "size of the base's sample to be judged")
          .within(5, 1e6)
          .by_default("half of the only sample, else the smallest sample"),
      option("other_size", &NoiseFloorOptions::other_size,
             "size of the sample that is compared with it")
          .within(5, 1e6)
          .by_default("size"),
      option("distance", &NoiseFloorOptions::distance, "distance between samples"),
      option("quantile", &NoiseFloorOptions::part,
             "fraction of the distances that lie below the floor")
          .within(0, 1),
      option("resamples", &NoiseFloorOptions::resamples,
             "number of distances drawn; for samples of exactly `size` values, the distances of "
             "all pairs instead")
          .within(kFewestResamples, kMostResamples),
      option("seed", &NoiseFloorOptions::seed, "seed of the random draws"));
}

/// Distribution of distances between samples of the base.
struct NoiseFloor {
  double level = 0;               ///< the quantile `part` of the distances [unit of the values]
  std::vector<double> distances;  ///< ascending
  std::uint32_t base_size = 0;
  std::uint32_t other_size = 0;
  SampleDistance distance = SampleDistance::wasserstein;
  double part = 0;
  /// The only source was too small for two disjoint samples, so values were drawn with replacement.
  bool with_replacement = false;
};

/// The noise floor: a quantile of the distances between samples of the base. `sources` are samples
/// of the base: other starts, half the time step, another integrator; of any size.
/// - If all sources have exactly the required size: the distances of all pairs (at least 7 sources,
///   21 pairs, for a 95 % quantile).
/// - Else each draw takes a pair of sources and draws the required number of values from each,
///   without replacement. Sources large enough for both samples are also paired with themselves, by
///   disjoint draws. A source that differs from the others raises the floor.
/// - A single source too small for both samples: with replacement.
/// The accuracy depends on the size of the source. Fraction of new base samples of 24 values inside
/// a 95 % floor (Wasserstein; 2000 repetitions), for normal and exponential distributions: source
/// of 24 values 91 and 87 %, 48 values 92 and 90 %, 96 values 95 and 93 %, 400 values 95 and 94 %.
/// For the energy distance: 93 to 95 % in all cases.
/// Throws InputError for no source, values that are not finite, and sources that are too small or
/// too few.
NoiseFloor noise_floor(const std::vector<std::vector<double>>& sources,
                       const NoiseFloorOptions& options = {});

struct FloorVerdict {
  double distance = 0;  ///< of the two samples [unit of the values]
  bool inside = false;  ///< distance not above the floor
  /// p-value: fraction of base-to-base distances at least as large, this distance included.
  double p = 1;
};

/// Compares the distance of two samples with the floor. Throws InputError unless the samples have
/// the sizes of the floor.
FloorVerdict inside_noise_floor(const NoiseFloor& floor, const std::vector<double>& base,
                                const std::vector<double>& other);

}  // namespace springlod::report
