#pragma once

#include <string>

#include "model/chain.hpp"
#include "report/csv.hpp"
#include "sim/study/compare.hpp"
#include "sim/study/stability_map.hpp"

// Tables of comparisons and of stability maps.
namespace springlod::report {

// Comparisons of levels (comparison_tables.cpp).

/// One row a level of `chain`: what it costs and how far it is off, means over the starts. Errors
/// also in percent of the base's bounding diagonal. No measured times: the same bits every time.
Table comparison_table(const sim::Comparison& comparison, const LodChain& chain);
/// Columns of comparison_table with their units, for help.
std::string comparison_columns_help();

/// One row a level and start.
Table starts_table(const sim::Comparison& comparison);
/// Measured times, one row a level and start.
Table timings_table(const sim::Comparison& comparison);

// Stability maps (stability_tables.cpp).

/// One row a point. No measured times: the same bits every time. A cell that does not apply (the
/// error of a run that diverged) is empty.
Table stability_table(const sim::StabilityMap& map);
/// Columns of stability_table with their units, for help.
std::string stability_columns_help();

/// One row a level and ratio: limits, frequencies, how exact the reference is.
Table stability_bodies_table(const sim::StabilityMap& map);
std::string stability_bodies_columns_help();

/// Measured times, one row a point that came to its end.
Table stability_timings_table(const sim::StabilityMap& map);

}  // namespace springlod::report
