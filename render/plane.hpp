#pragma once

#include <vector>

#include "render/camera.hpp"
#include "render/drawables.hpp"

namespace springlod::render {

/// Spacing of the grid lines [m]: a power of ten that suits the size of the view.
double grid_spacing(double view_radius);

/// Spacing of the arrows on a ramp [m]: 1, 2 or 5 times that of the grid, so that two to six of
/// them fit the height of the view at any scale.
double arrow_spacing(double view_radius);

/// The part of a plane near the camera's target, in coordinates relative to the target.
struct PlanePatch {
  Vec3f normal;
  float offset = 0;  ///< normal . x on the plane
  Vec3f center;      ///< projection of the target onto the plane
  Vec3f u, v;        ///< axes in the plane; v is as vertical as possible, uphill on a ramp
  float reach = 0;   ///< half side length of the patch [m]
  Eigen::Vector2f grid_origin;  ///< position of `center` on the world's grid [m]
  bool seen_from_behind = false;
  enum class Kind { floor, ramp, wall } kind = Kind::floor;
};

PlanePatch plane_patch(const DrawnPlane& plane, const Camera& camera, double aspect);

/// The part of a convex polygon with normal . x >= offset.
std::vector<Vec3f> clipped(const std::vector<Vec3f>& polygon, const Vec3f& normal, float offset);

/// A patch without the parts behind the other planes: a convex polygon; may be empty.
std::vector<Vec3f> visible_polygon(const std::vector<PlanePatch>& patches, std::size_t which);

/// The part of a polygon where bodies can cast a shadow or hide ambient light; `to_unit_cube` of
/// the shadow map.
std::vector<Vec3f> shaded_part(std::vector<Vec3f> polygon, const Mat4f& to_unit_cube);

/// The lines where a plane meets others, as thin rods that fade out with the planes. `radius` [m]
std::vector<SpringInstance> plane_edges(const std::vector<PlanePatch>& patches, std::size_t which,
                                        float radius);

}  // namespace springlod::render
