#include <vector>

#include "report/stats.hpp"

namespace springlod::report {

SampleComparison compare_samples(const StartSample& base, const StartSample& other,
                                 const SampleComparisonOptions& options) {
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
        return options.spread ? (mean(o) - mean(b)) / *options.spread
                              : report::difference_over_spread(b, o);
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
