#pragma once

#include <optional>

#include "base/choice.hpp"
#include "report/stats/bootstrap.hpp"
#include "report/stats/equivalence.hpp"

namespace springlod {

/// How means are tested for equivalence.
enum class MeanTest {
  student,    ///< test_equivalence
  bootstrap,  ///< bootstrap_equivalence
};

inline constexpr Choice<MeanTest> kMeanTests[] = {
    {MeanTest::student, "student", "Student's t"},
    {MeanTest::bootstrap, "bootstrap", "for values far from normal"}};
constexpr ChoiceTable<Choice<MeanTest>> choices(MeanTest) {
  return {"test", kMeanTests};
}

struct SampleComparisonOptions {
  BootstrapOptions resampling = {};   ///< pairing and design hold for the test as well
  double confidence = 0.95;           ///< of the intervals; the test is at 1 - confidence
  std::optional<double> margin = {};  ///< of the equivalence test; none: no test
  std::optional<double> spread = {};  ///< see EquivalenceOptions
  MeanTest test = MeanTest::student;
};

/// A number and the interval it is known to.
struct Measured {
  double value = 0;
  Interval interval;
};

/// How far the values of `other` are from those of `base`.
struct SampleComparison {
  Measured difference;              ///< of the means, other minus base [unit of the values]
  Measured difference_over_spread;  ///< [1]
  Measured wasserstein;             ///< 1-Wasserstein distance [unit of the values]
  Measured energy;                  ///< energy distance, without a root [unit of the values]
  std::optional<Equivalence> equivalence;
};

/// All of them on the same resamples: BCa intervals for the differences, percentile intervals for
/// the distances. Throws InputError as bootstrap and test_equivalence do.
SampleComparison compare_samples(const StartSample& base, const StartSample& other,
                                 const SampleComparisonOptions& options = {});

}  // namespace springlod
