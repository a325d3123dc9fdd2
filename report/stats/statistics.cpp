#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "base/error.hpp"
#include "base/message.hpp"
#include "report/stats.hpp"

namespace springlod::report {

namespace {

/// Integral of weight(F - G), where F and G are the empirical distribution functions.
template <class Weight>
double integral_between(std::vector<double> base, std::vector<double> other, Weight weight) {
  require_sample(base, 1, "base");
  require_sample(other, 1, "other");
  std::sort(base.begin(), base.end());
  std::sort(other.begin(), other.end());
  const auto base_count = static_cast<double>(base.size());
  const auto other_count = static_cast<double>(other.size());
  double sum = 0;
  double here = std::min(base.front(), other.front());
  std::size_t i = 0;
  std::size_t j = 0;
  while (i < base.size() || j < other.size()) {
    const bool from_base = j == other.size() || (i < base.size() && base[i] <= other[j]);
    const double next = from_base ? base[i] : other[j];
    const double gap = static_cast<double>(i) / base_count - static_cast<double>(j) / other_count;
    sum += weight(gap) * (next - here);
    here = next;
    ++(from_base ? i : j);
  }
  return sum;
}

}  // namespace

void require_sample(const std::vector<double>& sample, std::size_t least, std::string_view what) {
  if (sample.size() < least)
    throw InputError(
        fmt::format("statistics: the sample '{}' has {}, but at least {} are "
                    "needed; run more starts",
                    what, counted(sample.size(), "value"), least));
  for (std::size_t i = 0; i < sample.size(); ++i)
    if (!std::isfinite(sample[i]))
      throw InputError(
          fmt::format("statistics: value {} of the sample '{}' is {}, not a finite "
                      "number; check the run that it came from, or leave it out",
                      i + 1, what, sample[i]));
}

double mean(const std::vector<double>& sample) {
  require_sample(sample, 1, "sample");
  double sum = 0;
  for (const double value : sample) sum += value;
  return sum / static_cast<double>(sample.size());
}

double standard_deviation(const std::vector<double>& sample) {
  require_sample(sample, 2, "sample");
  const double center = mean(sample);
  double squares = 0;
  for (const double value : sample) squares += (value - center) * (value - center);
  return std::sqrt(squares / static_cast<double>(sample.size() - 1));
}

double sorted_quantile(const std::vector<double>& rising, double part) {
  const double place = part * static_cast<double>(rising.size() - 1);
  const auto below = static_cast<std::size_t>(place);
  const std::size_t above = std::min(below + 1, rising.size() - 1);
  // Infinite values cannot be interpolated.
  if (rising[below] == rising[above] || place == static_cast<double>(below)) return rising[below];
  return rising[below] + (place - static_cast<double>(below)) * (rising[above] - rising[below]);
}

double quantile(std::vector<double> sample, double part) {
  require_sample(sample, 1, "sample");
  if (!(part >= 0 && part <= 1))
    throw InputError(fmt::format("quantile: part is {}, must be 0 to 1", part));
  std::sort(sample.begin(), sample.end());
  return sorted_quantile(sample, part);
}

double difference_over_spread(const std::vector<double>& base, const std::vector<double>& other,
                              std::optional<double> spread) {
  require_sample(base, 2, "base");
  require_sample(other, 1, "other");
  const double difference = mean(other) - mean(base);
  const double unit = spread ? *spread : standard_deviation(base);
  if (unit > 0) return difference / unit;
  return difference == 0 ? 0 : std::copysign(std::numeric_limits<double>::infinity(), difference);
}

double wasserstein_distance(std::vector<double> base, std::vector<double> other) {
  return integral_between(std::move(base), std::move(other),
                          [](double gap) { return std::abs(gap); });
}

double energy_distance(std::vector<double> base, std::vector<double> other) {
  return integral_between(std::move(base), std::move(other),
                          [](double gap) { return 2 * gap * gap; });
}

}  // namespace springlod::report
