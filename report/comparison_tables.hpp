#pragma once

#include <string>

#include "model/chain.hpp"
#include "report/csv.hpp"
#include "sim/study/compare.hpp"

namespace springlod {

/// One row a level of `chain`: what it costs and how far it is off, means over the starts. Errors
/// also in percent of the base's bounding diagonal. No measured times: the same bits every time.
Table comparison_table(const Comparison& comparison, const LodChain& chain);
/// Columns of comparison_table with their units, for help.
std::string comparison_columns_help();

/// One row a level and start.
Table starts_table(const Comparison& comparison);
/// Measured times, one row a level and start.
Table timings_table(const Comparison& comparison);

}  // namespace springlod
