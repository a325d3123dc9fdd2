#pragma once

#include "sweep/plan.hpp"

namespace springlod::sweep {

/// Times between which a task should take [s]: long compared with what a cluster needs to start it,
/// and short enough to fill gaps between other jobs and to lose little when a machine fails.
inline constexpr double kShortestTask = 30;
inline constexpr double kLongestTask = 60;

/// Sets `tasks`: neighbouring units whose estimated times add up to about the mean of the two times
/// above, such that the number of tasks of a stage can be divided by 12 if there are as many. A
/// unit that takes longer is a task of its own.
void pack_tasks(Plan& plan);

}  // namespace springlod::sweep
