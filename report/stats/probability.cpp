#include "report/stats/probability.hpp"

#include <cmath>
#include <limits>

namespace springlod::report {

namespace {

// Enough bisections to reach double precision for all brackets used here.
constexpr int kHalvings = 200;

/// The x in low..high with rising(x) = target by bisection: robust and reproducible on all
/// machines.
template <class Rising>
double solve(double low, double high, double target, Rising rising) {
  for (int i = 0; i < kHalvings; ++i) {
    const double middle = 0.5 * (low + high);
    if (middle <= low || middle >= high) break;
    (rising(middle) < target ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

/// ln Gamma(x), x > 0: Stirling's series above kFar, reached by Gamma(x + 1) = x Gamma(x).
/// (std::lgamma is not thread-safe.)
double log_gamma(double x) {
  constexpr double kFar = 12;  // here five terms of the series have an error below 1e-14
  double shift = 0;
  while (x < kFar) {
    shift += std::log(x);
    x += 1;
  }
  const double r = 1 / (x * x);
  const double series =
      (1.0 / 12 - r * (1.0 / 360 - r * (1.0 / 1260 - r * (1.0 / 1680 - r / 1188)))) / x;
  constexpr double kHalfLogTwoPi = 0.91893853320467274178;
  return (x - 0.5) * std::log(x) - x + kHalfLogTwoPi + series - shift;
}

/// Continued fraction of the incomplete beta function (Abramowitz and Stegun 26.5.8), by Lentz's
/// method; fast for x < (a + 1) / (a + b + 2).
double beta_fraction(double x, double a, double b) {
  constexpr int kMostTerms = 10000;  // about sqrt(max(a, b)) are needed
  constexpr double kTiny = 1e-300;   // replaces a denominator of 0
  const auto away_from_zero = [](double v) { return std::abs(v) < kTiny ? kTiny : v; };
  double c = 1;
  double d = 1 / away_from_zero(1 - (a + b) * x / (a + 1));
  double value = d;
  for (int m = 1; m < kMostTerms; ++m) {
    const double even = m * (b - m) * x / ((a + 2 * m - 1) * (a + 2 * m));
    const double odd = -(a + m) * (a + b + m) * x / ((a + 2 * m) * (a + 2 * m + 1));
    d = 1 / away_from_zero(1 + even * d);
    c = away_from_zero(1 + even / c);
    value *= c * d;
    d = 1 / away_from_zero(1 + odd * d);
    c = away_from_zero(1 + odd / c);
    value *= c * d;
    if (std::abs(c * d - 1) < std::numeric_limits<double>::epsilon()) break;
  }
  return value;
}

/// I_x(a, b); `y` is 1 - x, a separate argument because it may be far smaller than 1.
double incomplete_beta(double x, double y, double a, double b) {
  if (x <= 0) return 0;
  if (y <= 0) return 1;
  const double front =
      std::exp(log_gamma(a + b) - log_gamma(a) - log_gamma(b) + a * std::log(x) + b * std::log(y));
  if (x < (a + 1) / (a + b + 2)) return front * beta_fraction(x, a, b) / a;
  return 1 - front * beta_fraction(y, b, a) / b;
}

}  // namespace

double normal_below(double z) {
  return 0.5 * std::erfc(-z * std::sqrt(0.5));
}

double normal_quantile(double part) {
  constexpr double kFarthest = 40;  // normal_below(-40) is 0 in a double
  if (part <= 0) return -std::numeric_limits<double>::infinity();
  if (part >= 1) return std::numeric_limits<double>::infinity();
  if (part > 0.5) return -normal_quantile(1 - part);  // doubles have a higher resolution near 0
  return solve(-kFarthest, 0, part, normal_below);
}

double student_above(double t, double degrees) {
  if (std::isinf(t)) return t > 0 ? 0 : 1;
  const double square = t * t;
  const double tail = 0.5 * incomplete_beta(degrees / (degrees + square),
                                            square / (degrees + square), 0.5 * degrees, 0.5);
  return t > 0 ? tail : 1 - tail;
}

double student_quantile(double part, double degrees) {
  constexpr double kFarthest = 1e15;  // tail probability below 1e-15 even for one degree of freedom
  if (part > 0.5) return -student_quantile(1 - part, degrees);
  return solve(-kFarthest, 0, part, [&](double t) { return student_above(-t, degrees); });
}

}  // namespace springlod::report
