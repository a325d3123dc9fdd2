#include <cmath>
#include <cstdint>
#include <vector>

#include <boost/math/distributions/students_t.hpp>
#include <fmt/format.h>

#include "base/error.hpp"
#include "report/stats.hpp"

namespace springlod::report {

namespace {

// Degrees of freedom that underflowed give an undefined p-value, and no exception.
using StudentsT = boost::math::students_t_distribution<
    double, boost::math::policies::policy<
                boost::math::policies::domain_error<boost::math::policies::ignore_error>>>;

void validate(const EquivalenceOptions& options) {
  if (!(options.margin > 0 && std::isfinite(options.margin)))
    throw InputError(fmt::format(
        "equivalence: margin is {}, must be above 0: the difference of means that counts "
        "as equivalent, in standard deviations of the base, such as 0.5",
        options.margin));
  if (!(options.alpha > 0 && options.alpha < 0.5))
    throw InputError(
        fmt::format("equivalence: alpha is {}, must be between 0 and 0.5, such "
                    "as 0.05",
                    options.alpha));
  if (options.spread && !(*options.spread > 0 && std::isfinite(*options.spread)))
    throw InputError(fmt::format("equivalence: spread is {}, must be above 0", *options.spread));
}

double spread_of(const std::vector<double>& base, const EquivalenceOptions& options) {
  const double spread = options.spread ? *options.spread : standard_deviation(base);
  if (spread > 0) return spread;
  throw InputError(
      "equivalence: all values of the base are equal, so that the margin is undefined; "
      "give the spread, or jitter the starts");
}

/// Influence of single starts or seeds on an estimate.
using Influence = std::vector<double>;

/// Means of the table values[start * seeds + seed] over its seeds and over its starts.
Influence by_start(const Influence& values, std::uint32_t seeds) {
  Influence means(values.size() / seeds, 0);
  for (std::size_t i = 0; i < values.size(); ++i) means[i / seeds] += values[i] / seeds;
  return means;
}
Influence by_seed(const Influence& values, std::uint32_t seeds) {
  const std::size_t starts = values.size() / seeds;
  Influence means(seeds, 0);
  for (std::size_t i = 0; i < values.size(); ++i)
    means[i % seeds] += values[i] / static_cast<double>(starts);
  return means;
}

/// An estimate with independent sources of variance.
struct Estimate {
  double value = 0;
  double variance = 0;  // of `value`
  double parts = 0;     // sum of variance^2 / degrees over the sources

  void add(const Influence& source) {
    const double deviation = standard_deviation(source);
    const double share = deviation * deviation / static_cast<double>(source.size());
    variance += share;
    parts += share * share / static_cast<double>(source.size() - 1);
  }
  /// p-value of the null hypothesis "0 or less" (Welch-Satterthwaite).
  double p_positive() const {
    if (variance == 0) return value > 0 ? 0 : 1;
    const StudentsT distribution(variance * variance / parts);
    return cdf(complement(distribution, value / std::sqrt(variance)));
  }
};

/// Distance of the difference from one end of the margin, spread * margin + sign * difference, and
/// its variance by the delta method (influence of a value x on a standard deviation s: ((x -
/// mean)^2 - s^2) / (2 s)).
Estimate room(const StartSample& base, const StartSample& other, const EquivalenceOptions& options,
              double sign) {
  const double spread = spread_of(base.values, options);
  const double base_mean = mean(base.values);
  const double other_mean = mean(other.values);
  Influence of_base;
  for (const double value : base.values) {
    const double away = value - base_mean;
    const double on_spread = options.spread ? 0 : (away * away - spread * spread) / (2 * spread);
    of_base.push_back(options.margin * on_spread - sign * away);
  }
  Influence of_other;
  for (const double value : other.values) of_other.push_back(sign * (value - other_mean));

  Estimate result;
  result.value = options.margin * spread + sign * (other_mean - base_mean);
  Influence base_starts = by_start(of_base, base.seeds);
  const Influence other_starts = by_start(of_other, other.seeds);
  if (options.paired) {
    for (std::size_t i = 0; i < base_starts.size(); ++i) base_starts[i] += other_starts[i];
  } else {
    result.add(other_starts);
  }
  result.add(base_starts);
  if (options.design == SeedDesign::crossed) {
    if (base.seeds > 1) result.add(by_seed(of_base, base.seeds));
    if (other.seeds > 1) result.add(by_seed(of_other, other.seeds));
  }
  return result;
}

}  // namespace

Equivalence test_equivalence(const StartSample& base, const StartSample& other,
                             const EquivalenceOptions& options) {
  validate(options);
  require_starts(base, "base");
  require_starts(other, "other");
  if (options.paired) require_pairs(base, other);
  Equivalence result;
  result.difference = mean(other.values) - mean(base.values);
  result.spread = spread_of(base.values, options);
  result.p_lower = room(base, other, options, 1).p_positive();
  result.p_higher = room(base, other, options, -1).p_positive();
  result.equivalent = result.p() <= options.alpha;
  return result;
}

Equivalence bootstrap_equivalence(const StartSample& base, const StartSample& other,
                                  const EquivalenceOptions& options,
                                  const BootstrapOptions& resampling) {
  validate(options);
  require_starts(base, "base");
  require_starts(other, "other");
  Equivalence result;
  result.difference = mean(other.values) - mean(base.values);
  result.spread = spread_of(base.values, options);
  const auto in_spreads = [&](const std::vector<double>& b, const std::vector<double>& o) {
    return difference_over_spread(b, o, options.spread);
  };
  const Bootstrap distribution = bootstrap(base, other, in_spreads, resampling);
  result.p_lower = confidence_below(distribution, -options.margin);
  result.p_higher = 1 - confidence_below(distribution, options.margin);
  result.equivalent = result.p() <= options.alpha;
  return result;
}

}  // namespace springlod::report
