#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "sim/run.hpp"
#include "sim/scenario.hpp"

namespace springlod {

/// The start of run number `index`: speed times 1 + jitter u1, height (z of the centre of mass)
/// times 1 + jitter u2, with u1, u2 uniform in [-1, 1) from (seed, index) alone; index 0 stays as
/// it is. `center`: centre of mass of the model, which a start that is not placed keeps.
Throw jittered(const Throw& start, const Vec3& center, double jitter, std::uint64_t seed,
               std::uint32_t index);

/// What is kept of one run of many.
struct RunSummary {
  double distance = 0;   ///< Scenario::measure_from at the end [m]
  double simulated = 0;  ///< [s]
  std::uint64_t spring_updates = 0;
  double wall_seconds = 0;  ///< measured; kept out of results
  double ledger_error = 0;  ///< closure_error; 0 without a ledger
  std::uint64_t unconverged_steps = 0;
  std::optional<double> first_crossing;  ///< when springs first turned over [s], see Trajectory
};

/// Runs the model from the scenario's start and sums it up. `center`: where the body's centre of
/// mass is if the start does not place it. `plan`: of the model under this scenario, whatever the
/// start. Errors are those of run, led by `name`.
Trajectory run_start(const MassSpringModel& model, const Scenario& scenario, const Vec3& center,
                     const RunOptions& options, const RunPlan& plan, const std::string& name,
                     RunSummary& summary);

}  // namespace springlod
