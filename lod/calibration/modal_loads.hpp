#pragma once

#include <vector>

#include <Eigen/Core>

#include "elastic/loads.hpp"
#include "lod/calibration/elastic_targets.hpp"
#include "model/chain.hpp"
#include "model/mass_spring.hpp"

namespace springlod::lod {

/// Mode shapes of the base as static loads on a level (docs/method.md, eqs. 30a and 30b). The
/// inertial forces M phi of a mode displace the base by phi / omega^2, so a level with the same
/// mode moves each node by the group mean of phi, over omega^2.
struct ModalLoads {
  std::vector<elastic::StaticLoad> loads;  ///< M phi of each mode, summed over the groups
  std::vector<std::vector<Vec3>> shapes;   ///< group means of phi of each mode [kg^-1/2]
  /// C0: work of load j along the base's displacement under load i, symmetrized [s2]. Those of two
  /// modes are 0 on the base, and nearly 0 on group means.
  Eigen::MatrixXd compliance;
};

/// Modal loads of a level with the masses of its groups. Forces on `held` nodes, which do no work,
/// are 0. Empty if the targets have no modal forces.
ModalLoads modal_loads(const MassSpringModel& level, const Groups& of_base,
                       const ElasticTargets& targets, const std::vector<std::uint32_t>& held);

}  // namespace springlod::lod
