#pragma once

#include <string>
#include <vector>

#include "elastic/elastic_body.hpp"
#include "model/mass_spring.hpp"

namespace springlod {

/// Forces on the nodes of a model. For a body that nothing holds they need not balance: what would
/// only push or turn a part, or move a mechanism, is taken out when the load is solved for.
struct StaticLoad {
  std::string name;
  std::vector<Vec3> force;  ///< N [N]
};

/// How a body gives way to a load.
struct StaticSolution {
  /// N [m]; without rigid motion: sum m u = 0 and sum m r x u = 0 over each part that nothing
  /// holds. 0 for anchored nodes.
  std::vector<Vec3> displacement;
  /// Work of the balanced (anchored: of the given) forces along the displacement, f.u [J]: twice
  /// the elastic energy.
  double compliance = 0;
  /// Size of the iteration's last step over that of the displacement, both weighted by mass: what
  /// iterating on would change.
  double residual = 0;
};

struct StaticOptions {
  /// What may be left of the forces, over them (both over the root of the masses), for a load to
  /// count as solved; 0: iterate until nothing changes but by rounding. Above 0 one solution with
  /// the factors is mostly enough, and `residual` tells nothing.
  double balance = 0;
};

/// Nine smooth loads: "stretch x", "stretch y", "stretch z", "shear yz", "shear xz", "shear xy",
/// two bends of the longest axis of the bounding box ("bend z to x") and a twist about it
/// ("twist z"); nodes without volume count for nothing. Forces per volume are linear in the place
/// (bends and twist: of second order) about the centre of volume; of each load their amounts add up
/// to 1 N. A load that finds nothing to pull at (the width of a flat model) is all zeros.
std::vector<StaticLoad> smooth_loads(const MassSpringModel& model);

/// K u = f for each load, with the rigid motions projected out: of the forces as the inertia of the
/// accelerated body would balance them (f - M Z Z^T f), of the displacements by mass. Conjugate
/// gradients, preconditioned by the factors of the body.
/// Throws InputError for a load of another size than N or with forces that are not finite; for a
/// body with anchored nodes, also where a load pushes at a motion that the anchors leave free.
std::vector<StaticSolution> solve_static(const ElasticBody& body,
                                         const std::vector<StaticLoad>& loads,
                                         const StaticOptions& options = {});

}  // namespace springlod
