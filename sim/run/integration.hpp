#pragma once

#include "sim/run.hpp"

namespace springlod::sim {

/// What `run` does once all is planned: takes the steps, watches over them and fills the
/// trajectory, whose step is set.
void integrate(const MassSpringModel& model, const Scenario& scenario, const State& start,
               const RunOptions& options, const RunPlan& plan, Trajectory& trajectory);

}  // namespace springlod::sim
