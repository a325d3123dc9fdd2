#include "sim/study/no_contact.hpp"

namespace springlod::sim {

std::optional<NoContact> no_contact(const Trajectory& run, const Scenario& scenario) {
  if (run.first_contact) return std::nullopt;
  NoContact found{.simulated = run.simulated};
  for (const Frame& frame : run.frames)
    for (const Obstacle& obstacle : scenario.obstacles)
      for (const Vec3& x : frame.x) {
        const double distance = surface_distance(obstacle, x).distance;
        if (found.nearest && distance >= *found.nearest) continue;
        found.nearest = distance;
        found.nearest_at = frame.time;
        found.obstacle = obstacle.name;
      }
  return found;
}

}  // namespace springlod::sim
