#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <string_view>
#include <vector>

#include "base/choice.hpp"
#include "base/progress.hpp"

// Statistics of samples of runs: the face of stats/, which needs nothing but base.
namespace springlod::report {

// One or two samples (statistics.cpp).

// Plain numbers of one or two samples. A sample is a list of values of one quantity, in any order;
// results are in its unit unless said otherwise. All throw InputError (which sample, which value,
// what to do) for a value that is not finite and for too few values.

/// Throws InputError unless `sample` has at least `least` values and all are finite. `what` names
/// the sample in the message: "base".
void require_sample(const std::vector<double>& sample, std::size_t least, std::string_view what);

/// At least one value.
double mean(const std::vector<double>& sample);

/// With n - 1 below the sum of squares: unbiased for the variance. At least two values.
double standard_deviation(const std::vector<double>& sample);

/// The value below which the part `part` (0..1) of the sample lies, linear between neighbours
/// (Hyndman and Fan 1996, type 7; what R and NumPy do unless told otherwise). At least one value.
double quantile(std::vector<double> sample, double part);
/// The same of a sample in rising order, not checked.
double sorted_quantile(const std::vector<double>& rising, double part);

/// Mean of `other` minus mean of `base`, over the standard deviation of `base` (Glass's delta)
/// [1]. Infinite, or 0 if the means are equal, for a base whose values are all the same. At least
/// two values in `base`.
double difference_over_spread(const std::vector<double>& base, const std::vector<double>& other);

/// 1-Wasserstein or earth mover's distance of the two samples as they stand: the integral of
/// |F - G| over their distribution functions, exact for any two sizes. How far, on the mean, values
/// would have to move to turn one sample into the other.
double wasserstein_distance(std::vector<double> base, std::vector<double> other);

/// Energy distance 2 E|X - Y| - E|X - X'| - E|Y - Y'|, the form *without* a square root (Szekely
/// and Rizzo 2013, "Energy statistics: a class of statistics based on distances"), so that
/// its unit is that of the values. Of the samples as they stand (pairs of a value with itself
/// count), thus never below 0, and 0 only for equal distribution functions. In one dimension it is
/// 2 times the integral of (F - G)^2, which is how it is computed.
double energy_distance(std::vector<double> base, std::vector<double> other);

// Samples by start and seed (start_sample.cpp).

/// Values of one quantity by start, or by start and simplification seed:
/// values[start * seeds + seed].
struct StartSample {
  std::vector<double> values;
  std::uint32_t seeds = 1;
  std::size_t starts() const { return values.size() / seeds; }
};

/// How the seeds of a StartSample relate to its starts.
enum class SeedDesign {
  crossed,  ///< the same seeds in every start: one chain a seed, run from every start
  nested    ///< other seeds in every start
};

inline constexpr Choice<SeedDesign> kSeedDesigns[] = {
    {SeedDesign::crossed, "crossed", "the same seeds in every start: one chain a seed"},
    {SeedDesign::nested, "nested", "other seeds in every start"}};
constexpr ChoiceTable<Choice<SeedDesign>> choices(SeedDesign) {
  return {"seeds", kSeedDesigns};
}

/// Of four starts there are but 35 different resamples, too few for the tail of anything.
constexpr std::size_t kLeastStarts = 5;

/// Throws InputError for fewer than kLeastStarts starts, a value that is not finite, a table with
/// holes. `what` names the sample in the message: "base".
void require_starts(const StartSample& sample, std::string_view what);
/// Throws InputError unless both have as many starts.
void require_pairs(const StartSample& base, const StartSample& other);

// Resampling (bootstrap.cpp).

struct BootstrapOptions {
  /// Start i of the base and start i of the other are the same start: they are drawn together.
  bool paired = false;
  SeedDesign design = SeedDesign::crossed;
  std::uint32_t resamples = 2000;  ///< 100 .. 1e6
  std::uint64_t seed = 1;
  Progress* progress = nullptr;
};

using OneSampleStatistic = std::function<double(const std::vector<double>&)>;
using TwoSampleStatistic =
    std::function<double(const std::vector<double>& base, const std::vector<double>& other)>;

/// What resampling tells of a statistic.
struct Bootstrap {
  double estimate = 0;            ///< of the data
  std::vector<double> resampled;  ///< of each resample, in rising order
  double bias = 0;                ///< z0 of BCa
  double acceleration = 0;        ///< a of BCa, by the jackknife over starts and seeds
};

/// Draws starts with replacement, and
/// - with crossed seeds draws starts and seeds apart and takes their table: the pigeonhole
/// bootstrap
///   (Owen 2007), which errs on the wide side where neither starts nor seeds matter. Of the seeds,
///   which are few, one fewer is drawn than there are: this makes the variance of a mean unbiased
///   (McCarthy and Snowden 1985). Even so 5 seeds that differ are few: a 95 % interval then holds
///   the truth in 89 %.
/// - with nested seeds draws a start with all its seeds, which carries the variance of both levels;
///   drawing seeds as well would count theirs twice (Davison and Hinkley 1997, 3.8).
/// Same seed, same bits; the draws depend on the sizes, the design and the seed alone, so that
/// several statistics see the same resamples. Throws InputError as require_starts and require_pairs
/// do, for resamples out of range, and for a statistic that is not a number.
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
  /// differences, quantiles. Right to second order where the statistic is smooth, skew included.
  bca,
  /// For distances, which have a corner at 0: there the bias that BCa takes out is not the same as
  /// that of the estimate. Two normal samples of 24, means half a deviation apart: the 95 %
  /// interval of the Wasserstein distance holds the truth in 96 % by percentile, 78 % by BCa. For
  /// samples of one distribution neither ever reaches the truth, 0: that is what the noise floor
  /// is for.
  percentile
};

/// Interval with `confidence` (0..1, such as 0.95) that the truth lies inside.
Interval interval(const Bootstrap& result, double confidence = 0.95,
                  IntervalMethod method = IntervalMethod::bca);

/// The confidence at which the truth is below `value`: that of the one-sided BCa interval that ends
/// there. 1 minus it is the p-value against "the truth is `value` or more".
double confidence_below(const Bootstrap& result, double value);

// Tests of equivalence (equivalence.cpp).

struct EquivalenceOptions {
  /// How far the means may be apart and still count as the same, in standard deviations of the
  /// base; > 0. A statement of whoever asks: there is no value that fits all.
  double margin = 0;
  /// Standard deviation of the base [unit of the values] if it is known from a larger sample. Else
  /// that of the base at hand, and the test takes its uncertainty into account.
  std::optional<double> spread = {};
  bool paired = false;
  SeedDesign design = SeedDesign::crossed;
  double alpha = 0.05;  ///< how often "equivalent" may be said of means a margin apart
};

/// Two one-sided tests (TOST, Schuirmann 1987): "the same" is said if both "lower by the margin or
/// more" and "higher by the margin or more" are refuted. Not refuting them is no statement at all.
struct Equivalence {
  double difference = 0;  ///< mean of the other minus mean of the base [unit of the values]
  double spread = 0;      ///< that the margin is measured by [unit of the values]
  double p_lower = 1;     ///< against "the other is lower by the margin or more"
  double p_higher = 1;    ///< against "the other is higher by the margin or more"
  bool equivalent = false;
  double p() const { return p_lower > p_higher ? p_lower : p_higher; }
};

/// By Student's distribution, with Welch's and Satterthwaite's degrees of freedom. `paired`: start
/// i of both is the same start, and the test is on the differences. Where the spread is the base's
/// own, the margin is uncertain too; its share of the standard error is added by the delta method
/// (for a margin taken as exact the test says "the same" too often: at 24 pairs that correlate by
/// 0.95 and a margin of 1, in 23 % of the cases where 5 % were asked for). Seeds that are crossed
/// with the starts add the variance between their means, which counts what is left over twice and
/// so errs on the safe side. Throws InputError for fewer than 5 starts, pairs of different length,
/// a margin or alpha out of range, and a base without spread.
Equivalence test_equivalence(const StartSample& base, const StartSample& other,
                             const EquivalenceOptions& options);

/// By the BCa bootstrap of difference_over_spread, with `resampling` in the place of the options of
/// the same name: for values far from normal. At 24 starts it says "the same" of means a margin
/// apart in 6 to 8 % where 5 % were asked for.
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
    {MeanTest::bootstrap, "bootstrap", "for values far from normal"}};
constexpr ChoiceTable<Choice<MeanTest>> choices(MeanTest) {
  return {"test", kMeanTests};
}

struct SampleComparisonOptions {
  BootstrapOptions resampling = {};   ///< pairing and design hold for the test as well
  double confidence = 0.95;           ///< of the intervals; the test is at 1 - confidence
  std::optional<double> margin = {};  ///< of the equivalence test; none: no test
  std::optional<double> spread = {};  ///< see EquivalenceOptions
  MeanTest test = MeanTest::student;
};

/// A number and the interval it is known to.
struct Measured {
  double value = 0;
  Interval interval;
};

/// How far the values of `other` are from those of `base`.
struct SampleComparison {
  Measured difference;              ///< of the means, other minus base [unit of the values]
  Measured difference_over_spread;  ///< [1]
  Measured wasserstein;             ///< 1-Wasserstein distance [unit of the values]
  Measured energy;                  ///< energy distance, without a root [unit of the values]
  std::optional<Equivalence> equivalence;
};

/// All of them on the same resamples: BCa intervals for the differences, percentile intervals for
/// the distances. Throws InputError as bootstrap and test_equivalence do.
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
  /// Values on either side of each distance: as many as the samples have that are to be judged,
  /// for a distance shrinks as samples grow. 0: half of the only source, else the smallest source.
  std::uint32_t base_size = 0;
  std::uint32_t other_size = 0;  ///< 0: as base_size
  SampleDistance distance = SampleDistance::wasserstein;
  double part = 0.95;              ///< of the distances that lie below the floor
  std::uint32_t resamples = 2000;  ///< distances drawn; 100 .. 1e6
  std::uint64_t seed = 1;
  Progress* progress = nullptr;
};

/// Distances that the base has from itself.
struct NoiseFloor {
  double level = 0;               ///< the quantile `part` of the distances [unit of the values]
  std::vector<double> distances;  ///< in rising order
  std::uint32_t base_size = 0;
  std::uint32_t other_size = 0;
  SampleDistance distance = SampleDistance::wasserstein;
  double part = 0;
  /// The only source was too small for two samples without a common value, so values were drawn
  /// with replacement.
  bool with_replacement = false;
};

/// The noise floor of base-against-base distances. `sources` are samples of the base: other starts,
/// half the step, another integrator; any number of values each.
/// - Sources that all have exactly the size asked for: the distances of all pairs of them (at
///   least 7 sources, 21 pairs, for a 95 % quantile to be among them).
/// - Else each draw takes a pair of sources and from each, without replacement, as many values as
///   asked for; a source with enough values for both sides is paired with itself as well, by
///   disjoint draws. A source that differs from the others thus raises the floor.
/// - One source of fewer values than both sides need: with replacement.
/// How good one source is depends on its size. Of new base samples of 24 values, normal ..
/// exponential, these fell inside the 95 % floor (Wasserstein; 2000 repetitions): source of 24
/// values 91 .. 87 %, 48 values 92 .. 90 %, 96 values 95 .. 93 %, 400 values 95 .. 94 %. The energy
/// distance: 93 to 95 % for all of them.
/// Throws InputError for no source, values that are not finite, sources that are too small or too
/// few.
NoiseFloor noise_floor(const std::vector<std::vector<double>>& sources,
                       const NoiseFloorOptions& options = {});

struct FloorVerdict {
  double distance = 0;  ///< of the two samples [unit of the values]
  bool inside = false;  ///< not above the floor: no farther than the base is from itself
  double p =
      1;  ///< how often the base is as far from itself, or farther (the draw at hand counted)
};

/// Throws InputError unless the samples have the sizes of the floor.
FloorVerdict inside_noise_floor(const NoiseFloor& floor, const std::vector<double>& base,
                                const std::vector<double>& other);

}  // namespace springlod::report
