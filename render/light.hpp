#pragma once

#include "render/camera.hpp"

namespace springlod::render {

/// The shadow-casting light: directional, at a fixed angle to the camera's horizontal direction, so
/// that the side facing the viewer is lit.
struct KeyLight {
  Vec3f direction = Vec3f::UnitZ();        ///< towards the light
  Mat4f projection = Mat4f::Identity();    ///< world to clip space of the shadow map
  Mat4f to_unit_cube = Mat4f::Identity();  ///< world to texture coordinates and depth, 0..1
  float side = 1;                          ///< extent of the shadow map [m]
  float depth = 1;                         ///< depth range of the shadow map [m]
};

/// `casters`: bounding box of the shadow casters, relative to the camera's target; may be empty.
KeyLight key_light(const Camera& camera, const Box3& casters);

}  // namespace springlod::render
