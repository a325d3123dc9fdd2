#pragma once

#include "model/mass_spring.hpp"
#include "sim/run.hpp"
#include "sim/scenario.hpp"

namespace springlod::sim {

/// Processor time that a simulated second of the model takes on this machine [s/s]: measured over a
/// few hundred steps from the start of the scenario, without contacts. Not reproducible. With an
/// implicit scheme, a step from rest takes fewer iterations than one of a deformed body.
double measured_cost(const MassSpringModel& model, const Scenario& scenario,
                     const RunOptions& options, const RunPlan& plan);

/// The same of a run: its processor time over the simulated time in which the body was awake.
double cost_of(const Trajectory& run);

}  // namespace springlod::sim
