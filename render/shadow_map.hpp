#pragma once

#include "render/gl.hpp"

namespace springlod::render {

/// A depth texture seen from the key light.
class ShadowMap {
 public:
  ShadowMap();
  /// Makes it the target and clears it.
  void begin() const;
  /// Binds it for reading: compared at texture unit 0, plain depths at unit 1.
  void bind() const;
  static constexpr GLsizei kSide = 1024;  ///< [texels]: finer than the soft edge needs

 private:
  GlTexture depth_;
  GlFramebuffer target_;
  GlSampler compare_;
  GlSampler plain_;
};

}  // namespace springlod::render
