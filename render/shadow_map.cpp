#include "render/shadow_map.hpp"

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

ShadowMap::ShadowMap()
    : depth_(make_texture()),
      target_(make_framebuffer()),
      compare_(make_sampler()),
      plain_(make_sampler()) {
  glBindTexture(GL_TEXTURE_2D, depth_.name());
  glTexImage2D(GL_TEXTURE_2D, 0, GL_DEPTH_COMPONENT32F, kSide, kSide, 0, GL_DEPTH_COMPONENT,
               GL_FLOAT, nullptr);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAX_LEVEL, 0);
  set_sampler(compare_, GL_LINEAR, GL_COMPARE_REF_TO_TEXTURE);
  set_sampler(plain_, GL_NEAREST, GL_NONE);
  glBindFramebuffer(GL_FRAMEBUFFER, target_.name());
  glFramebufferTexture2D(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_TEXTURE_2D, depth_.name(), 0);
  glDrawBuffer(GL_NONE);
  glReadBuffer(GL_NONE);
}

void ShadowMap::begin() const {
  glBindFramebuffer(GL_FRAMEBUFFER, target_.name());
  glViewport(0, 0, kSide, kSide);
  glClear(GL_DEPTH_BUFFER_BIT);
}

void ShadowMap::bind() const {
  for (const auto& [unit, sampler] : {std::pair{0U, &compare_}, {1U, &plain_}}) {
    glActiveTexture(GL_TEXTURE0 + unit);
    glBindTexture(GL_TEXTURE_2D, depth_.name());
    glBindSampler(unit, sampler->name());
  }
}

}  // namespace springlod::render
