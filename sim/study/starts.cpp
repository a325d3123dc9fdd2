#include <algorithm>
#include <random>

#include <fmt/format.h>

#include "base/error.hpp"
#include "sim/study/ensemble.hpp"

namespace springlod::sim {

Throw jittered(const Throw& start, const Vec3& center, double jitter, std::uint64_t seed,
               std::uint32_t index) {
  if (index == 0) return start;
  Throw changed = start;
  changed.position = start.placed ? start.position : center;
  changed.placed = true;
  std::seed_seq sequence{static_cast<std::uint32_t>(seed), static_cast<std::uint32_t>(seed >> 32U),
                         index};
  std::mt19937_64 random(sequence);
  const auto factor = [&] {
    const double unit = static_cast<double>(random() >> 11U) * 0x1p-53;  // [0, 1)
    return 1 + jitter * (2 * unit - 1);
  };
  changed.velocity *= factor();
  changed.position.z() *= factor();
  return changed;
}

bool starts_differ(const Scenario& scenario, const Vec3& center, double jitter,
                   const std::vector<Anchor>& anchors) {
  if (jitter == 0) return false;
  if (scenario.start.velocity != Vec3::Zero()) return true;
  const Vec3& position = scenario.start.placed ? scenario.start.position : center;
  if (position.z() == 0) return false;
  const bool turns = std::any_of(anchors.begin(), anchors.end(), [](const Anchor& anchor) {
    return anchor.pivot.has_value() && !anchor.path.empty();
  });
  return turns || !scenario.obstacles.empty();
}

Trajectory run_start(const MassSpringModel& model, const Scenario& scenario, const Vec3& center,
                     const RunOptions& options, const RunPlan& plan, const std::string& name,
                     RunSummary& summary) {
  try {
    Trajectory trajectory =
        run(model, scenario, initial_state(model, scenario.start), options, plan);
    summary.distance =
        measured_distance(scenario, scenario.start.placed ? scenario.start.position : center,
                          center_of_mass(model, trajectory.final.x));
    summary.simulated = trajectory.simulated;
    summary.spring_updates = trajectory.spring_updates;
    summary.wall_seconds = trajectory.wall_seconds;
    summary.ledger_error = closure_error(trajectory.ledger);
    summary.unconverged_steps = trajectory.unconverged_steps;
    if (trajectory.first_crossing) summary.first_crossing = trajectory.first_crossing->time;
    if (trajectory.inversions.first) summary.first_inversion = trajectory.inversions.first->time;
    summary.most_inverted = trajectory.inversions.most;
    summary.inverted_at_end = trajectory.inverted_at_end;
    return trajectory;
  } catch (const UnstableError& e) {
    throw UnstableError(fmt::format("{}: {}", name, e.what()), e.node(), e.time());
  } catch (const TunnelError& e) {
    throw TunnelError(fmt::format("{}: {}", name, e.what()), e.node(), e.obstacle(), e.time());
  }
}

}  // namespace springlod::sim
