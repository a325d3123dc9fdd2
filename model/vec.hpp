#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>

namespace springlod {

/// Position [m], velocity [m/s] or force [N]. Default construction leaves it uninitialised.
using Vec3 = Eigen::Vector3d;
using Mat3 = Eigen::Matrix3d;
/// Axis-aligned box; default construction makes the empty box.
using Box3 = Eigen::AlignedBox3d;

}  // namespace springlod
