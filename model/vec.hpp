#pragma once

#include <vector>

#include <Eigen/Core>
#include <Eigen/Geometry>

namespace springlod::inline model {

/// Position [m], velocity [m/s] or force [N]. Default construction leaves it uninitialised.
using Vec3 = Eigen::Vector3d;
using Mat3 = Eigen::Matrix3d;
/// Axis-aligned box; default construction makes the empty box.
using Box3 = Eigen::AlignedBox3d;

/// The bounding box of the points.
inline Box3 bounds(const std::vector<Vec3>& points) {
  Box3 box;
  for (const Vec3& point : points) box.extend(point);
  return box;
}

}  // namespace springlod::inline model
