#pragma once

#include <cstddef>
#include <string_view>
#include <vector>

namespace springlod {

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

}  // namespace springlod
