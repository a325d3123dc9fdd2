#pragma once

#include "render/gl.hpp"

namespace springlod::render {

/// A depth texture: of the key light (shadow map), or of the camera for ambient occlusion.
class DepthMap {
 public:
  /// [texels]
  DepthMap(GLsizei width, GLsizei height);
  /// Makes it the render target and clears it.
  void begin() const;
  /// Binds it for reading plain depths at a texture unit.
  void bind_plain(GLuint unit) const;
  /// Binds it for depth comparison at a texture unit.
  void bind_compare(GLuint unit) const;

 private:
  void bind(GLuint unit, const GlSampler& sampler) const;

  GLsizei width_;
  GLsizei height_;
  GlTexture depth_;
  GlFramebuffer target_;
  GlSampler compare_;
  GlSampler plain_;
};

}  // namespace springlod::render
