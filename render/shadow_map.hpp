#pragma once

#include "render/gl.hpp"

namespace springlod::render {

/// A depth texture rendered from the key light.
class ShadowMap {
 public:
  ShadowMap();
  /// Makes it the render target and clears it.
  void begin() const;
  /// Binds it for reading: depth comparison at texture unit 0, plain depths at unit 1.
  void bind() const;
  static constexpr GLsizei kSide = 1024;  ///< [texels]; finer than the soft shadow edge requires

 private:
  GlTexture depth_;
  GlFramebuffer target_;
  GlSampler compare_;
  GlSampler plain_;
};

}  // namespace springlod::render
