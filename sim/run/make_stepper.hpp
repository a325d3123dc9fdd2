#pragma once

#include <memory>

#include "sim/integrators/stepper.hpp"
#include "sim/run.hpp"

namespace springlod::sim {

/// The stepper of the integrator that `options` name, with steps of `step` [s]. Model, scenario and
/// the plan's layout must outlive it.
std::unique_ptr<Stepper> make_stepper(const MassSpringModel& model, const Scenario& scenario,
                                      const State& start, double step, const RunOptions& options,
                                      const RunPlan& plan);

}  // namespace springlod::sim
