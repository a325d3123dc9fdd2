#include "lod/calibration/modal_loads.hpp"

#include <cmath>
#include <utility>

#include <fmt/format.h>

namespace springlod::lod {

ModalLoads modal_loads(const MassSpringModel& level, const Groups& of_base,
                       const ElasticTargets& targets, const std::vector<std::uint32_t>& held) {
  ModalLoads modal;
  const auto modes = static_cast<Eigen::Index>(targets.modal_forces.size());
  // Forces over the roots of the masses: products of two columns are f_j . P_i, P = f / m.
  Eigen::MatrixXd scaled(3 * static_cast<Eigen::Index>(level.node_count()), modes);
  for (const std::vector<Vec3>& force : targets.modal_forces) {
    const auto i = static_cast<Eigen::Index>(modal.loads.size());
    elastic::StaticLoad load =
        summed_over_groups(of_base, {fmt::format("inertia of mode {}", i + 1), force});
    for (const std::uint32_t node : held) load.force[node].setZero();
    std::vector<Vec3>& shape = modal.shapes.emplace_back(load.force);
    for (std::uint32_t node = 0; node < level.node_count(); ++node) {
      shape[node] /= level.mass[node];
      scaled.col(i).segment<3>(3 * static_cast<Eigen::Index>(node)) =
          load.force[node] / std::sqrt(level.mass[node]);
    }
    modal.loads.push_back(std::move(load));
  }
  modal.compliance = scaled.transpose() * scaled;
  for (Eigen::Index i = 0; i < modes; ++i)
    for (Eigen::Index j = 0; j < modes; ++j)
      modal.compliance(i, j) *= 0.5 * (1 / targets.squared_frequency[static_cast<std::size_t>(i)] +
                                       1 / targets.squared_frequency[static_cast<std::size_t>(j)]);
  return modal;
}

}  // namespace springlod::lod
