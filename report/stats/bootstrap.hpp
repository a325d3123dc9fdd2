#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "base/progress.hpp"
#include "report/stats/start_sample.hpp"

namespace springlod {

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

}  // namespace springlod
