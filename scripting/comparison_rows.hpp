#pragma once

#include <string>

#include "report/csv.hpp"
#include "scripting/values.hpp"

namespace springlod {

/// One row a level: what it costs and how far it is off, means over the starts. Errors also in
/// percent of the base's bounding diagonal. No measured times: the same bits every time.
Table comparison_table(const ComparisonValue& value);
/// Columns of comparison_table with their units, for help.
std::string comparison_columns_help();

/// One row a level and start.
Table starts_table(const ComparisonValue& value);
/// Measured times, one row a level and start.
Table timings_table(const ComparisonValue& value);

/// Diagonal of the bounding box of the base at rest [m].
double base_diagonal(const LodAsset& chain);

}  // namespace springlod
