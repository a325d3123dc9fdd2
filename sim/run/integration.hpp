#pragma once

#include "sim/run.hpp"

namespace springlod::sim {

/// Executes a planned run: takes and checks the steps and fills in the trajectory, whose step is
/// already set.
void integrate(const MassSpringModel& model, const Scenario& scenario, const State& start,
               const RunOptions& options, const RunPlan& plan, Trajectory& trajectory);

}  // namespace springlod::sim
