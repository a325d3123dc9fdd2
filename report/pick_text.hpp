#pragma once

#include <string>

#include "report/csv.hpp"
#include "sim/study/pick.hpp"

namespace springlod::report {

/// What the picked level gains and loses, and what its neighbours would: a few sentences.
std::string pick_text(const sim::Pick& pick);

/// One row per level: level, nodes, springs, cost [s], cost_ratio (base / level), error,
/// error_percent, within.
Table pick_table(const sim::Pick& pick);
/// Columns of pick_table with their units, for help.
std::string pick_columns_help();

}  // namespace springlod::report
