#pragma once

#include "render/scene.hpp"

namespace springlod::render {

using Mat4f = Eigen::Matrix4f;
using Vec3f = Eigen::Vector3f;

/// The camera's axes in the world; `back` points from the target to the eye.
struct CameraAxes {
  Vec3 right;
  Vec3 up;
  Vec3 back;
};
/// Falls back to another up vector when the camera looks along its own.
CameraAxes camera_axes(const Camera& camera);

/// Half the height of the view at the target [m].
double view_radius(const Camera& camera);

/// Matrix from world coordinates relative to `camera.target` to clip space. Relative coordinates
/// keep single precision accurate far from the origin.
Mat4f view_projection(const Camera& camera, double aspect);

}  // namespace springlod::render
