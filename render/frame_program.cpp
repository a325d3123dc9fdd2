#include "render/frame_program.hpp"

namespace springlod::render {

GlProgram frame_program(const char* name, const ShaderSource& source) {
  GlProgram made = make_program(name, source.vertex, source.fragment);
  glUniformBlockBinding(made.name(), glGetUniformBlockIndex(made.name(), "Frame"), 0);
  glUseProgram(made.name());
  const auto place = [&](const char* sampler, LightMap map) {
    glUniform1i(uniform(made, sampler), static_cast<GLint>(map));
  };
  place("shadow_compare", LightMap::shadow_compare);
  place("shadow_depth", LightMap::shadow_depth);
  place("body_depth", LightMap::body_depth);
  return made;
}

GLint uniform(const GlProgram& of, const char* name) {
  return glGetUniformLocation(of.name(), name);
}

void set(const GlProgram& of, const char* name, const Vec3f& v) {
  glUniform3fv(uniform(of, name), 1, v.data());
}

void set(const GlProgram& of, const char* name, float v) {
  glUniform1f(uniform(of, name), v);
}

}  // namespace springlod::render
