#pragma once

#include <string>

#include "model/chain.hpp"
#include "report/csv.hpp"
#include "sim/study/compare.hpp"
#include "sim/study/stability_map.hpp"

// Tables of comparisons and of stability maps.
namespace springlod::report {

// Comparisons of levels (comparison_tables.cpp).

/// One row per level of `chain`: cost and errors, means over the starts. Errors also in percent of
/// the bounding diagonal of the base. Contains no measured times: results are reproducible to the
/// bit.
Table comparison_table(const sim::Comparison& comparison, const LodChain& chain);
/// Columns of comparison_table with their units, for help.
std::string comparison_columns_help();

/// One row per level and start.
Table starts_table(const sim::Comparison& comparison);
/// Measured times, one row per level and start.
Table timings_table(const sim::Comparison& comparison);

// Stability maps (stability_tables.cpp).

/// One row per point. Contains no measured times: results are reproducible to the bit. Cells that
/// do not apply (the error of a diverged run) are empty.
Table stability_table(const sim::StabilityMap& map);
/// Columns of stability_table with their units, for help.
std::string stability_columns_help();

/// One row per level and ratio: step limit, frequency error, error of the reference run.
Table stability_bodies_table(const sim::StabilityMap& map);
std::string stability_bodies_columns_help();

/// Measured times, one row per completed run.
Table stability_timings_table(const sim::StabilityMap& map);

}  // namespace springlod::report
