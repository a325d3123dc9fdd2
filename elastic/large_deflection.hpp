#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "base/progress.hpp"
#include "model/anchors.hpp"
#include "model/mass_spring.hpp"

namespace springlod::elastic {

/// What a body is loaded with, at large displacements.
struct LargeLoad {
  std::vector<Vec3> force;  ///< N, the same wherever the nodes move [N]
  /// Nodes whose positions are prescribed, and springs that pull nodes to places, with forces of
  /// stiffness times distance.
  Support anchored;
  /// Writes the places of the anchored nodes and of those on springs when the given part (0 to 1)
  /// of the load acts [m]; null: they are those at rest.
  std::function<void(double part, std::vector<Vec3>& places)> hold = nullptr;
};

struct LargeOptions {
  /// An equilibrium is found when the forces that are left are at most this fraction of those that
  /// act, the load or the forces of the anchors, or are rounding [1].
  double tolerance = 1e-9;
  Progress* progress = nullptr;  ///< may be null
};

struct LargeSolution {
  std::vector<Vec3> displacement;  ///< N, from rest [m]
  /// N: of what holds the nodes of the support, on the body; 0 at all others [N].
  std::vector<Vec3> reaction;
  double energy = 0;             ///< of springs, those of the support, and dilatation terms [J]
  std::uint32_t load_steps = 0;  ///< equilibria on the way, the last included
  std::uint32_t iterations = 0;  ///< of Newton's method in all
  double residual = 0;           ///< forces left over those that act: see LargeOptions [1]
};

/// The equilibrium of an anchored body under a load, at any displacements and rotations: a minimum
/// of the energy of its springs, those of its support, and dilatation terms less the work of the
/// load. The load is applied
/// in steps, as few as Newton's method with a line search can follow; each step starts from the
/// equilibrium before. Corners are left out: they resist only where the body is nearly flattened.
///
/// Throws InputError for a load of another size than N or that is not finite, for anchors that
/// leave a motion free, and where the steps become too small: the body then snaps through or
/// collapses, and the message says at which part of the load.
LargeSolution deflect_far(const MassSpringModel& model, const LargeLoad& load,
                          const LargeOptions& options = {});

}  // namespace springlod::elastic
