#include "scripting/bind/tables/start_overlap.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "base/units.hpp"

namespace springlod::scripting {

namespace {

// How far a body may reach into an obstacle without a warning, in mean spring lengths [1]: a body
// may well start at rest on a floor, as far in as its weight presses it.
constexpr double kLikelyMeant = 0.5;

}  // namespace

std::optional<std::string> overlap_warning(const std::string& owner, const MassSpringModel& model,
                                           const sim::Scenario& scenario) {
  const State start = sim::initial_state(model, scenario.start);
  double depth = kLikelyMeant * mean_spring_length(model);
  const sim::Obstacle* deepest = nullptr;
  for (const sim::Obstacle& obstacle : scenario.obstacles)
    for (const Vec3& x : start.x) {
      const double inside = -sim::surface_distance(obstacle, x).distance;
      if (inside > depth) {
        depth = inside;
        deepest = &obstacle;
      }
    }
  if (!deepest) return std::nullopt;
  return fmt::format(
      "{}: the body starts {} deep inside {}, which will throw it out; change throw.position or "
      "the obstacle",
      owner, format_quantity(depth, Dimension::length),
      deepest->name.empty() ? "an obstacle" : "the obstacle " + deepest->name);
}

}  // namespace springlod::scripting
