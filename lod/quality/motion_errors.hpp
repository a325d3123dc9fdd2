#pragma once

#include <vector>

#include "elastic/modes.hpp"
#include "model/chain.hpp"

// Errors of a level in motions that its base's kLowestModes lowest modes make up, without running
// either.
namespace springlod::lod {

/// Sum of m x . y over the nodes of a model.
double mass_product(const std::vector<double>& mass, const std::vector<Vec3>& x,
                    const std::vector<Vec3>& y);

/// A level and its base with their lowest modes. `shapes`: means of the base's shapes over the
/// groups of the level (group_means).
struct ModalMotion {
  const MassSpringModel& base;
  const Level& level;
  const std::vector<elastic::Mode>& base_modes;
  const std::vector<elastic::Mode>& level_modes;
  const std::vector<std::vector<Vec3>>& shapes;
};

/// Error of the velocities right after blows that give the base the velocities of its modes
/// (docs/method.md, eq. 50a) [1]. 0 if each node has the mass of its group.
double blow_error(const ModalMotion& motion);

/// Error of the displacements in the first period of the lowest mode, if base and level start with
/// the velocities of each of the base's modes (docs/method.md, eq. 50b) [1].
double first_period_error(const ModalMotion& motion);

/// Rate at which the springs' damping makes the amplitude of a mode fall [1/s].
double decay_rate(const MassSpringModel& model, const elastic::Mode& mode);

}  // namespace springlod::lod
