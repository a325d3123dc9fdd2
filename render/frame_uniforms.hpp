#pragma once

#include <array>
#include <cstddef>

#include "render/camera.hpp"

namespace springlod::render {

inline constexpr std::size_t kMostPlanes = 8;  // that occlude bodies; size of the shaders' array

/// The uniform block of the shaders in std140 layout; only 16-byte members, hence no padding.
struct FrameUniforms {
  Mat4f view_projection;
  Mat4f shadow_projection;
  Mat4f from_clip;
  Eigen::Vector4f eye;
  Eigen::Vector4f key_light;
  Eigen::Vector4f world_up;
  Eigen::Vector4f camera_right;
  Eigen::Vector4f shadow_size;
  Eigen::Vector4f pixel;
  std::array<Eigen::Vector4f, kMostPlanes> planes;
  Eigen::Vector4f image;
};

}  // namespace springlod::render
