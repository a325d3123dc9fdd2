#pragma once

#include <vector>

#include "render/camera.hpp"

namespace springlod::render {

/// Spacing of the grid lines [m]: 1, or a power of ten that suits the size of the view.
double grid_spacing(double view_radius);

/// A plane cut to what the camera looks at, relative to the camera's target.
struct PlanePatch {
  Vec3f normal;
  float offset = 0;             ///< normal . x on the plane
  Vec3f center;                 ///< foot of the target
  Vec3f u, v;                   ///< axes in the plane; v is as upright as it can be
  float reach = 0;              ///< half side of the patch [m]
  Eigen::Vector2f grid_origin;  ///< where `center` lies on the world's grid [m]
  bool seen_from_behind = false;
  bool upright = false;  ///< a wall
};

PlanePatch plane_patch(const DrawnPlane& plane, const Camera& camera, double aspect);

}  // namespace springlod::render
