#pragma once

#include <vector>

#include "base/choice.hpp"
#include "report/chart.hpp"
#include "report/labelled_run.hpp"

namespace springlod::report {

/// What a chart of runs shows over time.
enum class RunQuantity { height, distance, speed, kinetic, elastic, mechanical };

/// A row of the table of quantities; in the order in which help lists them.
struct RunQuantityChoice : Choice<RunQuantity> {
  const char* axis;  ///< label of the vertical axis, with the unit
  std::vector<ChartPoint> (*points)(const LabelledRun& run);
};
ChoiceTable<RunQuantityChoice> choices(RunQuantity);

/// A line for each run: the quantity in SI units at the times of its frames [s]. A run that ended
/// before others has a shorter line. Throws InputError for a run with fewer than three frames, and
/// for energies of a run without a ledger.
std::vector<ChartSeries> run_series(const std::vector<LabelledRun>& runs, RunQuantity quantity);

/// Axes with their units; the title is the name of the scenario if the runs share one.
ChartOptions run_chart(const std::vector<LabelledRun>& runs, RunQuantity quantity);

}  // namespace springlod::report
