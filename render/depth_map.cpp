#include "render/depth_map.hpp"

namespace springlod::render {
namespace {

void set_sampler(const GlSampler& sampler, GLint filter, GLint compare_mode) {
  const GLuint name = sampler.name();
  glSamplerParameteri(name, GL_TEXTURE_MIN_FILTER, filter);
  glSamplerParameteri(name, GL_TEXTURE_MAG_FILTER, filter);
  glSamplerParameteri(name, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
  glSamplerParameteri(name, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
  glSamplerParameteri(name, GL_TEXTURE_COMPARE_MODE, compare_mode);
  glSamplerParameteri(name, GL_TEXTURE_COMPARE_FUNC, GL_LEQUAL);
}

}  // namespace

DepthMap::DepthMap(GLsizei width, GLsizei height)
    : width_(width),
      height_(height),
      depth_(make_texture()),
      target_(make_framebuffer()),
      compare_(make_sampler()),
      plain_(make_sampler()) {
  glBindTexture(GL_TEXTURE_2D, depth_.name());
  glTexImage2D(GL_TEXTURE_2D, 0, GL_DEPTH_COMPONENT32F, width, height, 0, GL_DEPTH_COMPONENT,
               GL_FLOAT, nullptr);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAX_LEVEL, 0);
  set_sampler(compare_, GL_LINEAR, GL_COMPARE_REF_TO_TEXTURE);
  set_sampler(plain_, GL_NEAREST, GL_NONE);
  glBindFramebuffer(GL_FRAMEBUFFER, target_.name());
  glFramebufferTexture2D(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_TEXTURE_2D, depth_.name(), 0);
  glDrawBuffer(GL_NONE);
  glReadBuffer(GL_NONE);
}

void DepthMap::begin() const {
  glBindFramebuffer(GL_FRAMEBUFFER, target_.name());
  glViewport(0, 0, width_, height_);
  glClear(GL_DEPTH_BUFFER_BIT);
}

void DepthMap::bind_plain(GLuint unit) const {
  bind(unit, plain_);
}
void DepthMap::bind_compare(GLuint unit) const {
  bind(unit, compare_);
}

void DepthMap::bind(GLuint unit, const GlSampler& sampler) const {
  glActiveTexture(GL_TEXTURE0 + unit);
  glBindTexture(GL_TEXTURE_2D, depth_.name());
  glBindSampler(unit, sampler.name());
}

}  // namespace springlod::render
