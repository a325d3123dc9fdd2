#pragma once

#include <string>

#include "report/csv.hpp"
#include "sim/study/stability_map.hpp"

namespace springlod {

/// One row a point. No measured times: the same bits every time. A cell that does not apply (the
/// error of a run that diverged) is empty.
Table stability_table(const StabilityMap& map);
/// Columns of stability_table with their units, for help.
std::string stability_columns_help();

/// One row a level and ratio: limits, frequencies, how exact the reference is.
Table stability_bodies_table(const StabilityMap& map);
std::string stability_bodies_columns_help();

/// Measured times, one row a point that came to its end.
Table stability_timings_table(const StabilityMap& map);

}  // namespace springlod
