#pragma once

#include <optional>
#include <string>

#include "sim/run.hpp"
#include "sim/scenario.hpp"

namespace springlod::sim {

/// A run in which the body touched no obstacle, so that errors of levels are those of free motion.
struct NoContact {
  double simulated = 0;  ///< [s]
  /// Smallest distance of a node from an obstacle in the frames of the run [m], with the time and
  /// the name of the obstacle ("" without a name); none without obstacles.
  std::optional<double> nearest = std::nullopt;
  double nearest_at = 0;  ///< [s]
  std::string obstacle = {};
};

/// Nothing if the run had a contact.
std::optional<NoContact> no_contact(const Trajectory& run, const Scenario& scenario);

}  // namespace springlod::sim
