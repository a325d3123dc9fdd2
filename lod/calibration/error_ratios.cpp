#include "lod/calibration/error_ratios.hpp"

#include <algorithm>
#include <cstddef>
#include <initializer_list>
#include <vector>

#include "lod/calibration/tolerance.hpp"

namespace springlod::lod {
namespace {

/// Tolerances of patch and piece loads, and of region loads, relative to that of the ten lowest
/// frequencies (docs/method.md, eq. 44).
constexpr double kPatchLoadsTolerance = 8, kRegionLoadsTolerance = 8;

double mean(const std::vector<double>& values, std::size_t begin, std::size_t end) {
  end = std::min(end, values.size());
  double sum = 0;
  for (std::size_t i = begin; i < end; ++i) sum += values[i];
  return end > begin ? sum / static_cast<double>(end - begin) : 0;
}

double mean_of_loads(const ElasticResiduals& residuals, const ElasticTargets& targets,
                     std::initializer_list<LoadKind> kinds) {
  std::vector<double> of_kinds;
  for (std::size_t l = 0; l < targets.loads.size(); ++l)
    if (std::find(kinds.begin(), kinds.end(), targets.loads[l].kind) != kinds.end())
      of_kinds.push_back(residuals.compliance_error[l]);
  return mean(of_kinds, 0, of_kinds.size());
}

}  // namespace

ErrorRatios error_ratios(const ElasticResiduals& residuals, const ElasticTargets& targets,
                         double tolerance) {
  const auto of = [&](std::initializer_list<LoadKind> kinds) {
    return mean_of_loads(residuals, targets, kinds);
  };
  const std::vector<double>& frequency = residuals.frequency_error;
  ErrorRatios ratios{mean_frequency_error(residuals),
                     mean(frequency, kLowestModes, frequency.size()) / kHigherModesTolerance,
                     of({LoadKind::smooth}) / kSmoothLoadsTolerance,
                     of({LoadKind::piece, LoadKind::patch}) / kPatchLoadsTolerance,
                     of({LoadKind::region}) / kRegionLoadsTolerance};
  for (double& ratio : ratios) ratio /= tolerance;
  return ratios;
}

double mean_frequency_error(const ElasticResiduals& residuals) {
  return mean(residuals.frequency_error, 0, kLowestModes);
}

}  // namespace springlod::lod
