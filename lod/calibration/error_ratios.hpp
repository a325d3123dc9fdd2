#pragma once

#include <array>

#include "lod/calibration/elastic_fit.hpp"
#include "lod/calibration/elastic_targets.hpp"

namespace springlod::lod {

/// Mean errors of a level by kind, each over the tolerance of its kind (docs/method.md, eq. 44):
/// modes 1 to 10, higher modes, smooth loads, patch and piece loads, region loads [1]; 0 for a kind
/// without targets.
using ErrorRatios = std::array<double, 5>;

/// `tolerance` is that of the ten lowest frequencies, see frequency_tolerance [1].
ErrorRatios error_ratios(const ElasticResiduals& residuals, const ElasticTargets& targets,
                         double tolerance);

/// Mean error of the ten lowest frequencies [1]; 0 without modes.
double mean_frequency_error(const ElasticResiduals& residuals);

}  // namespace springlod::lod
