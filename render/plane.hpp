#pragma once

#include <vector>

#include "render/camera.hpp"

namespace springlod::render {

/// Spacing of the grid lines [m]: a power of ten that suits the size of the view.
double grid_spacing(double view_radius);

/// The part of a plane near the camera's target, in coordinates relative to the target.
struct PlanePatch {
  Vec3f normal;
  float offset = 0;             ///< normal . x on the plane
  Vec3f center;                 ///< projection of the target onto the plane
  Vec3f u, v;                   ///< axes in the plane; v is as vertical as possible
  float reach = 0;              ///< half side length of the patch [m]
  Eigen::Vector2f grid_origin;  ///< position of `center` on the world's grid [m]
  bool seen_from_behind = false;
  bool upright = false;  ///< a wall
};

PlanePatch plane_patch(const DrawnPlane& plane, const Camera& camera, double aspect);

}  // namespace springlod::render
