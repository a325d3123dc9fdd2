#include <cmath>
#include <functional>
#include <limits>
#include <numbers>

#include <boost/math/distributions/normal.hpp>
#include <catch2/catch.hpp>

#include "base/error.hpp"
#include "report/stats.hpp"
#include "tests/report/samples.hpp"

using namespace springlod;
using namespace springlod::report;
using namespace springlod::test;
using Catch::Matchers::Contains;

namespace {

/// The energy distance by its definition, over all pairs.
double energy_by_pairs(const Values& x, const Values& y) {
  const auto mean_distance = [](const Values& a, const Values& b) {
    double sum = 0;
    for (const double p : a)
      for (const double q : b) sum += std::abs(p - q);
    return sum / static_cast<double>(a.size() * b.size());
  };
  return 2 * mean_distance(x, y) - mean_distance(x, x) - mean_distance(y, y);
}

/// Quantiles at equal steps of probability: a sample almost without random error.
Values even_sample(int size, const std::function<double(double)>& quantile_function) {
  Values values;
  for (int i = 0; i < size; ++i) values.push_back(quantile_function((i + 0.5) / size));
  return values;
}

}  // namespace

TEST_CASE("mean, deviation and quantiles of a sample") {
  const Values sample{4, 1, 2, 3};
  CHECK(mean(sample) == 2.5);
  CHECK(standard_deviation(sample) == Approx(std::sqrt(5.0 / 3)));
  CHECK(quantile(sample, 0) == 1);
  CHECK(quantile(sample, 1) == 4);
  CHECK(quantile(sample, 0.5) == 2.5);
  CHECK(quantile(sample, 0.25) == 1.75);  // as in R and NumPy
  CHECK(quantile({7}, 0.3) == 7);
}

TEST_CASE("the difference of means is measured in spreads of the base") {
  CHECK(difference_over_spread({1, 2, 3}, {5}) == 3);
  CHECK(difference_over_spread({1, 2, 3}, {1, 1, 1}) == -1);
  CHECK(difference_over_spread({2, 2}, {2, 2}) == 0);
  CHECK(difference_over_spread({2, 2}, {1}) == -std::numeric_limits<double>::infinity());
}

TEST_CASE("distances of small samples match hand calculations") {
  CHECK(wasserstein_distance({0, 1}, {3, 0, 0}) == Approx(5.0 / 6).epsilon(1e-14));
  CHECK(wasserstein_distance({1, 2, 3}, {3, 1, 2}) == 0);
  CHECK(wasserstein_distance({0}, {-2}) == 2);
  CHECK(energy_distance({0}, {1}) == 2);  // 2 * 1 - 0 - 0
  const Values x{0.5, 1, 1, 4, 2.25};
  const Values y{1, 3, -2};
  CHECK(energy_distance(x, y) == Approx(energy_by_pairs(x, y)).epsilon(1e-13));
  CHECK(energy_distance(y, x) == Approx(energy_by_pairs(x, y)).epsilon(1e-13));
  CHECK(energy_distance(x, x) == 0);
}

TEST_CASE("a shifted sample is as far as it was shifted") {
  RandomStream chance(1);
  const Values sample = exponential_sample(chance, 100);
  for (const double shift : {-3.0, 0.01, 40.0})
    CHECK(wasserstein_distance(sample, shifted(sample, shift)) ==
          Approx(std::abs(shift)).epsilon(1e-12));
}

TEST_CASE("distances of large samples are those of their distributions") {
  constexpr int kSize = 20000;
  const auto uniform = [](double p) { return p; };
  const auto wide = [](double p) { return 2 * p; };
  const auto exponential = [](double p) { return -std::log1p(-p); };
  const auto slow = [](double p) { return -2 * std::log1p(-p); };
  const auto normal = [](double p) { return quantile(boost::math::normal(), p); };
  const auto wide_normal = [&](double p) { return 2 * normal(p); };
  struct Case {
    std::function<double(double)> base, other;
    double wasserstein, energy;
  };
  // Energy of two normals: E|X - Y| of centred normals is sqrt(2 variance / pi).
  const double normal_energy =
      2 * std::sqrt(2 * 5 / std::numbers::pi) - (1 + 2) * 2 / std::sqrt(std::numbers::pi);
  const std::vector<Case> cases{
      {uniform, wide, 0.5, 1.0 / 3},
      {exponential, slow, 1, 1.0 / 3},
      {normal, wide_normal, std::sqrt(2 / std::numbers::pi), normal_energy}};
  for (const Case& c : cases) {
    // The samples may have different sizes.
    const Values base = even_sample(kSize, c.base);
    const Values other = even_sample(kSize / 2 * 3, c.other);
    CHECK(wasserstein_distance(base, other) == Approx(c.wasserstein).epsilon(1e-3));
    CHECK(energy_distance(base, other) == Approx(c.energy).epsilon(1e-3));
  }
  RandomStream chance(2);
  const Values base = normal_sample(chance, kSize);
  const Values other = normal_sample(chance, kSize, 1);
  // Random error 4 sqrt(2 / n) = 0.04; E|N(1, 2)| is computed by hand.
  CHECK(wasserstein_distance(base, other) == Approx(1).margin(0.04));
  const double between = 2 / std::sqrt(std::numbers::pi) * std::exp(-0.25) + 1 -
                         2 * cdf(boost::math::normal(), -std::sqrt(0.5));
  CHECK(energy_distance(base, other) ==
        Approx(2 * between - 4 / std::sqrt(std::numbers::pi)).margin(0.04));
}

TEST_CASE("values that are no numbers and samples that are too small are refused by name") {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  CHECK_THROWS_WITH(wasserstein_distance({1, 2}, {1, nan}),
                    Contains("value 2") && Contains("'other'"));
  CHECK_THROWS_WITH(energy_distance({}, {1}), Contains("'base' has 0 values"));
  CHECK_THROWS_AS(standard_deviation({1}), InputError);
  CHECK_THROWS_AS(mean({}), InputError);
  CHECK_THROWS_AS(mean({HUGE_VAL}), InputError);
  CHECK_THROWS_AS(quantile({1, 2}, 1.5), InputError);
  CHECK_THROWS_AS(quantile({1, 2}, nan), InputError);
}
