#pragma once

#include "render/camera.hpp"

namespace springlod::render {

/// The one light that casts shadows: parallel rays, fixed to the camera's horizontal direction so
/// that the viewer's side is always lit.
struct KeyLight {
  Vec3f direction = Vec3f::UnitZ();        ///< towards the light
  Mat4f projection = Mat4f::Identity();    ///< to clip space of the shadow map
  Mat4f to_unit_cube = Mat4f::Identity();  ///< the same to 0..1
  float side = 1;                          ///< of the shadow map [m]
  float depth = 1;                         ///< [m]
};

/// `casters`: box around what throws shadows, relative to the camera's target; may be empty.
KeyLight key_light(const Camera& camera, const Box3& casters);

}  // namespace springlod::render
