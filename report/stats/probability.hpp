#pragma once

namespace springlod::report {

// Distribution functions for intervals and tests, accurate to 1e-12 or better.

/// P(Z <= z) of the standard normal distribution.
double normal_below(double z);
/// The z with P(Z <= z) = part; -inf for part = 0, inf for part = 1.
double normal_quantile(double part);

/// P(T > t) of Student's t distribution with `degrees` > 0 degrees of freedom, not necessarily an
/// integer (Welch). By the incomplete beta function (Abramowitz and Stegun 26.7.1).
double student_above(double t, double degrees);
/// The t with P(T <= t) = part, 0 < part < 1.
double student_quantile(double part, double degrees);

}  // namespace springlod::report
