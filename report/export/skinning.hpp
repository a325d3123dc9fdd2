#pragma once

#include <cstdint>
#include <vector>

#include <Eigen/Geometry>

#include "report/export/draft.hpp"
#include "report/export/motion.hpp"

namespace springlod::report {

/// Poses of the nodes of a model: where each is, and how it has turned since rest.
struct NodePoses {
  std::vector<Vec3> position;                ///< [m] N
  std::vector<Eigen::Quaterniond> rotation;  ///< unit, N
};
/// The rotation of a node is that which brings the springs at rest to those at `x` with the least
/// squares (Kabsch 1976); where they do not fix it, that of the whole body decides.
NodePoses node_poses(const MassSpringModel& model, const std::vector<Vec3>& x);

/// Linear blend skinning of P vertices on J joints, each a node: vertex = sum of weight (R (v - r)
/// + x) over its joints, with the rest positions v and r.
struct Skinning {
  std::uint32_t influences = 4;      ///< joints of each vertex; unused ones have weight 0
  std::vector<std::uint32_t> node;   ///< of each joint, J; only nodes that move a vertex
  std::vector<std::uint32_t> joint;  ///< P * influences
  std::vector<float> weight;         ///< P * influences, >= 0, with the sum 1
  double mean_error = 0;             ///< root mean square over all vertices and frames [m]
  double largest_error = 0;          ///< [m]
};

/// The weights that follow the motion best: by least squares over some of its frames, for each
/// vertex over the nodes that carry it. `poses`: of each frame.
Skinning fit_skinning(const ExportedMotion& motion, const std::vector<NodePoses>& poses,
                      std::uint32_t influences);

}  // namespace springlod::report
