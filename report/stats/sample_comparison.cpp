#include <cmath>
#include <vector>

#include <fmt/format.h>

#include "base/error.hpp"
#include "report/stats.hpp"

namespace springlod::report {

namespace {

void validate(const SampleComparisonOptions& options) {
  if (!(options.confidence > 0.5 && options.confidence < 1))
    throw InputError(fmt::format(
        "comparison of samples: confidence is {}, must be above 0.5 and below 1, such as 0.95",
        options.confidence));
  if (options.spread && !(*options.spread > 0 && std::isfinite(*options.spread)))
    throw InputError(
        fmt::format("comparison of samples: spread is {}, must be above 0", *options.spread));
}

}  // namespace

SampleComparison compare_samples(const StartSample& base, const StartSample& other,
                                 const SampleComparisonOptions& options) {
  validate(options);
  const auto measured = [&](const TwoSampleStatistic& statistic, IntervalMethod method) {
    const Bootstrap result = bootstrap(base, other, statistic, options.resampling);
    return Measured{result.estimate, interval(result, options.confidence, method)};
  };
  using Values = std::vector<double>;
  SampleComparison result;
  result.difference = measured([](const Values& b, const Values& o) { return mean(o) - mean(b); },
                               IntervalMethod::bca);
  result.difference_over_spread = measured(
      [&](const Values& b, const Values& o) {
        return report::difference_over_spread(b, o, options.spread);
      },
      IntervalMethod::bca);
  result.wasserstein = measured(wasserstein_distance, IntervalMethod::percentile);
  result.energy = measured(energy_distance, IntervalMethod::percentile);
  if (!options.margin) return result;
  const EquivalenceOptions test{.margin = *options.margin,
                                .spread = options.spread,
                                .paired = options.resampling.paired,
                                .design = options.resampling.design,
                                .alpha = 1 - options.confidence};
  result.equivalence = options.test == MeanTest::bootstrap
                           ? bootstrap_equivalence(base, other, test, options.resampling)
                           : test_equivalence(base, other, test);
  return result;
}

}  // namespace springlod::report
