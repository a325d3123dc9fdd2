#pragma once

// Samples of known distributions, the same on every machine.

#include <cmath>
#include <vector>

#include <boost/math/distributions/normal.hpp>

#include "base/random.hpp"

namespace springlod::test {

using Values = std::vector<double>;

inline double normal_draw(RandomStream& chance) {
  // The middle of one of 2^53 cells of (0, 1), which excludes both ends.
  return quantile(boost::math::normal(), chance.unit() + 0x1p-54);
}

inline Values normal_sample(RandomStream& chance, int size, double mean = 0, double deviation = 1) {
  Values values(static_cast<std::size_t>(size));
  for (double& value : values) value = mean + deviation * normal_draw(chance);
  return values;
}

/// Exponential values of mean 1.
inline Values exponential_sample(RandomStream& chance, int size) {
  Values values(static_cast<std::size_t>(size));
  for (double& value : values) value = -std::log1p(-chance.unit());
  return values;
}

/// Standard normal values with `correlation` to given standard normal values.
inline Values partner_of(const Values& base, double correlation, RandomStream& chance) {
  Values values;
  for (const double value : base)
    values.push_back(correlation * value +
                     std::sqrt(1 - correlation * correlation) * normal_draw(chance));
  return values;
}

inline Values shifted(Values values, double by) {
  for (double& value : values) value += by;
  return values;
}

/// Fraction of `repetitions` for which says(chance) is true; each has its own random stream.
template <class Says>
double frequency(int repetitions, std::uint64_t seed, Says says) {
  int count = 0;
  for (int i = 0; i < repetitions; ++i) {
    RandomStream chance(seed, static_cast<std::uint64_t>(i));
    count += says(chance) ? 1 : 0;
  }
  return static_cast<double>(count) / repetitions;
}

/// Random error of a frequency: four standard deviations of a binomial count, exceeded once in
/// 16,000 cases.
inline double stray(double part, int repetitions) {
  return 4 * std::sqrt(part * (1 - part) / repetitions);
}

}  // namespace springlod::test
