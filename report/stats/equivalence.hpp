#pragma once

#include <optional>

#include "report/stats/bootstrap.hpp"

namespace springlod {

struct EquivalenceOptions {
  /// How far the means may be apart and still count as the same, in standard deviations of the
  /// base; > 0. A statement of whoever asks: there is no value that fits all.
  double margin = 0;
  /// Standard deviation of the base [unit of the values] if it is known from a larger sample. Else
  /// that of the base at hand, and the test takes its uncertainty into account.
  std::optional<double> spread = {};
  bool paired = false;
  SeedDesign design = SeedDesign::crossed;
  double alpha = 0.05;  ///< how often "equivalent" may be said of means a margin apart
};

/// Two one-sided tests (TOST, Schuirmann 1987): "the same" is said if both "lower by the margin or
/// more" and "higher by the margin or more" are refuted. Not refuting them is no statement at all.
struct Equivalence {
  double difference = 0;  ///< mean of the other minus mean of the base [unit of the values]
  double spread = 0;      ///< that the margin is measured by [unit of the values]
  double p_lower = 1;     ///< against "the other is lower by the margin or more"
  double p_higher = 1;    ///< against "the other is higher by the margin or more"
  bool equivalent = false;
  double p() const { return p_lower > p_higher ? p_lower : p_higher; }
};

/// By Student's distribution, with Welch's and Satterthwaite's degrees of freedom. `paired`: start
/// i of both is the same start, and the test is on the differences. Where the spread is the base's
/// own, the margin is uncertain too; its share of the standard error is added by the delta method
/// (for a margin taken as exact the test says "the same" too often: at 24 pairs that correlate by
/// 0.95 and a margin of 1, in 23 % of the cases where 5 % were asked for). Seeds that are crossed
/// with the starts add the variance between their means, which counts what is left over twice and
/// so errs on the safe side. Throws InputError for fewer than 5 starts, pairs of different length,
/// a margin or alpha out of range, and a base without spread.
Equivalence test_equivalence(const StartSample& base, const StartSample& other,
                             const EquivalenceOptions& options);

/// By the BCa bootstrap of difference_over_spread, with `resampling` in the place of the options of
/// the same name: for values far from normal. At 24 starts it says "the same" of means a margin
/// apart in 6 to 8 % where 5 % were asked for.
Equivalence bootstrap_equivalence(const StartSample& base, const StartSample& other,
                                  const EquivalenceOptions& options,
                                  const BootstrapOptions& resampling);

}  // namespace springlod
