#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include <boost/math/distributions/normal.hpp>
#include <fmt/format.h>

#include "base/error.hpp"
#include "base/random.hpp"
#include "report/stats.hpp"

namespace springlod::report {

namespace {

// The jackknife leaves out single values up to this number, otherwise as many blocks: the mean
// acceleration is the same, and the cost is not quadratic in the sample size.
constexpr std::size_t kMostBlocks = 500;

// An infinite or undefined argument gives an infinite or undefined result, and no exception.
using boost::math::policies::domain_error;
using boost::math::policies::ignore_error;
using boost::math::policies::overflow_error;
using Normal = boost::math::normal_distribution<
    double,
    boost::math::policies::policy<domain_error<ignore_error>, overflow_error<ignore_error>>>;

using Samples = std::vector<std::vector<double>>;
using Statistic = std::function<double(const Samples&)>;
using Numbers = std::vector<std::uint32_t>;

/// The starts and seeds that a resample draws from one sample.
struct Draw {
  Numbers starts;
  Numbers seeds;
};

Numbers all_of(std::size_t count) {
  Numbers numbers(count);
  std::iota(numbers.begin(), numbers.end(), 0U);
  return numbers;
}

/// All but block `left_out` of `blocks` of about the same size.
Numbers all_but(std::size_t count, std::size_t left_out, std::size_t blocks) {
  Numbers numbers = all_of(count);
  const auto first = static_cast<std::ptrdiff_t>(left_out * count / blocks);
  const auto last = static_cast<std::ptrdiff_t>((left_out + 1) * count / blocks);
  numbers.erase(numbers.begin() + first, numbers.begin() + last);
  return numbers;
}

Numbers drawn(std::size_t from, std::size_t count, RandomStream& chance) {
  Numbers numbers(count);
  for (std::uint32_t& number : numbers) number = chance.below(static_cast<std::uint32_t>(from));
  return numbers;
}

std::vector<double> taken(const StartSample& sample, const Draw& draw) {
  std::vector<double> values;
  values.reserve(draw.starts.size() * draw.seeds.size());
  for (const std::uint32_t start : draw.starts)
    for (const std::uint32_t seed : draw.seeds)
      values.push_back(sample.values[std::size_t{start} * sample.seeds + seed]);
  return values;
}

void validate(const BootstrapOptions& options) {
  if (options.resamples < kFewestResamples || options.resamples > kMostResamples)
    throw InputError(fmt::format("bootstrap: resamples is {}, must be {} to {}", options.resamples,
                                 kFewestResamples, kMostResamples));
}

class Resampling {
 public:
  Resampling(std::vector<StartSample> samples, Statistic statistic, const BootstrapOptions& options)
      : samples_(std::move(samples)), statistic_(std::move(statistic)), options_(options) {
    validate(options);
    for (std::size_t i = 0; i < samples_.size(); ++i)
      require_starts(samples_[i], samples_.size() == 1 ? "sample" : i == 0 ? "base" : "other");
    if (paired()) require_pairs(samples_[0], samples_[1]);
  }

  Bootstrap run() const {
    Bootstrap result;
    result.estimate = evaluate(whole());
    if (!std::isfinite(result.estimate))
      throw InputError(
          fmt::format("bootstrap: the statistic of the data is {}; the base may have "
                      "no spread, by which the statistic divides",
                      result.estimate));
    Task task(options_.progress, "resampling", options_.resamples);
    result.resampled.reserve(options_.resamples);
    for (std::uint32_t r = 0; r < options_.resamples; ++r) {
      result.resampled.push_back(evaluate(resample(r)));
      task.advance();
    }
    if (std::any_of(result.resampled.begin(), result.resampled.end(),
                    [](double value) { return std::isnan(value); }))
      throw InputError("bootstrap: the statistic of a resample is not a number; run more starts");
    std::sort(result.resampled.begin(), result.resampled.end());
    result.acceleration = acceleration();
    return result;
  }

 private:
  bool paired() const { return options_.paired && samples_.size() == 2; }

  double evaluate(const std::vector<Draw>& draws) const {
    Samples values;
    for (std::size_t i = 0; i < samples_.size(); ++i)
      values.push_back(taken(samples_[i], draws[i]));
    return statistic_(values);
  }

  std::vector<Draw> whole() const {
    std::vector<Draw> draws;
    for (const StartSample& sample : samples_)
      draws.push_back({all_of(sample.starts()), all_of(sample.seeds)});
    return draws;
  }

  bool draws_seeds(const StartSample& sample) const {
    return options_.design == SeedDesign::crossed && sample.seeds > 1;
  }

  /// Every resample has its own random stream.
  std::vector<Draw> resample(std::uint32_t number) const {
    RandomStream chance(options_.seed, number);
    std::vector<Draw> draws;
    for (const StartSample& sample : samples_) {
      Draw& draw = draws.emplace_back();
      const bool together = paired() && draws.size() == 2;
      draw.starts =
          together ? draws.front().starts : drawn(sample.starts(), sample.starts(), chance);
      draw.seeds = draws_seeds(sample) ? drawn(sample.seeds, sample.seeds - 1, chance)
                                       : all_of(sample.seeds);
    }
    return draws;
  }

  /// Leaves out each start and each seed in turn (Efron and Tibshirani 1993, eq. 14.15; for
  /// several samples Davison and Hinkley 1997, 5.3).
  double acceleration() const {
    JackknifeSums sums;
    for (std::size_t i = 0; i < samples_.size(); ++i) {
      const std::size_t starts = samples_[i].starts();
      const std::size_t blocks = std::min(starts, kMostBlocks);
      if (i == 0 || !paired())
        sums.add(blocks, [&](std::size_t left_out) {
          std::vector<Draw> draws = whole();
          for (std::size_t j = 0; j < draws.size(); ++j)
            if (j == i || paired()) draws[j].starts = all_but(starts, left_out, blocks);
          return evaluate(draws);
        });
      if (draws_seeds(samples_[i]))
        sums.add(samples_[i].seeds, [&](std::size_t left_out) {
          std::vector<Draw> draws = whole();
          draws[i].seeds = all_but(samples_[i].seeds, left_out, samples_[i].seeds);
          return evaluate(draws);
        });
    }
    return sums.acceleration();
  }

  /// Sums of squares and cubes of the influence of each unit.
  class JackknifeSums {
   public:
    template <class Without>
    void add(std::size_t units, Without without) {
      std::vector<double> values(units);
      for (std::size_t u = 0; u < units; ++u) values[u] = without(u);
      const auto count = static_cast<double>(units);
      const double center = std::accumulate(values.begin(), values.end(), 0.0) / count;
      for (const double value : values) {
        const double influence = (count - 1) / count * (center - value);
        squares_ += influence * influence;
        cubes_ += influence * influence * influence;
      }
    }
    double acceleration() const {
      const double a = cubes_ / (6 * squares_ * std::sqrt(squares_));
      return std::isfinite(a) ? a : 0;  // no unit has an influence, or the statistic is not finite
    }

   private:
    double squares_ = 0;
    double cubes_ = 0;
  };

  std::vector<StartSample> samples_;
  Statistic statistic_;
  const BootstrapOptions& options_;
};

/// Fraction of the resamples below `value`; equal ones count half. Clamped away from 0 and 1, which
/// a finite number of resamples cannot resolve.
double part_below(const std::vector<double>& rising, double value) {
  const auto [first, last] = std::equal_range(rising.begin(), rising.end(), value);
  const auto count = static_cast<double>(rising.size());
  const auto below = static_cast<double>(first - rising.begin());
  const auto equal = static_cast<double>(last - first);
  return std::clamp((below + 0.5 * equal) / count, 1 / (count + 1), count / (count + 1));
}

Bootstrap resampled(std::vector<StartSample> samples, Statistic statistic,
                    const BootstrapOptions& options) {
  Bootstrap result = Resampling(std::move(samples), std::move(statistic), options).run();
  result.bias = quantile(Normal(), part_below(result.resampled, result.estimate));
  return result;
}

/// Quantile order of the one-sided BCa limit with confidence `part` (Efron and Tibshirani 1993,
/// eq. 14.10).
double corrected(const Bootstrap& result, double part) {
  const double shifted = result.bias + quantile(Normal(), part);
  const double stretch = 1 - result.acceleration * shifted;
  if (stretch <= 0) return shifted < 0 ? 0 : 1;  // outside the range of the correction
  return cdf(Normal(), result.bias + shifted / stretch);
}

}  // namespace

Bootstrap bootstrap(const StartSample& sample, const OneSampleStatistic& statistic,
                    const BootstrapOptions& options) {
  return resampled(
      {sample}, [&](const Samples& s) { return statistic(s[0]); }, options);
}

Bootstrap bootstrap(const StartSample& base, const StartSample& other,
                    const TwoSampleStatistic& statistic, const BootstrapOptions& options) {
  return resampled(
      {base, other}, [&](const Samples& s) { return statistic(s[0], s[1]); }, options);
}

Interval interval(const Bootstrap& result, double confidence, IntervalMethod method) {
  if (!(confidence > 0 && confidence < 1))
    throw InputError(
        fmt::format("interval: confidence is {}, must be between 0 and 1, such as "
                    "0.95",
                    confidence));
  const double tail = 0.5 * (1 - confidence);
  const auto limit = [&](double part) {
    if (method == IntervalMethod::bca) part = corrected(result, part);
    return sorted_quantile(result.resampled, part);
  };
  return {limit(tail), limit(1 - tail)};
}

double confidence_below(const Bootstrap& result, double value) {
  const double shifted = quantile(Normal(), part_below(result.resampled, value)) - result.bias;
  const double stretch = 1 + result.acceleration * shifted;
  if (stretch <= 0) return shifted < 0 ? 0 : 1;
  return cdf(Normal(), shifted / stretch - result.bias);
}

}  // namespace springlod::report
