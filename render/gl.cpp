#include "render/gl.hpp"

#include <cstddef>

#include <fmt/format.h>

#include "base/error.hpp"

namespace springlod::render {

void delete_buffer(GLuint name) {
  glDeleteBuffers(1, &name);
}
void delete_vertex_array(GLuint name) {
  glDeleteVertexArrays(1, &name);
}
void delete_texture(GLuint name) {
  glDeleteTextures(1, &name);
}
void delete_framebuffer(GLuint name) {
  glDeleteFramebuffers(1, &name);
}
void delete_program(GLuint name) {
  glDeleteProgram(name);
}
void delete_sampler(GLuint name) {
  glDeleteSamplers(1, &name);
}

GlBuffer make_buffer() {
  GLuint name = 0;
  glGenBuffers(1, &name);
  return GlBuffer(name);
}
GlVertexArray make_vertex_array() {
  GLuint name = 0;
  glGenVertexArrays(1, &name);
  return GlVertexArray(name);
}
GlTexture make_texture() {
  GLuint name = 0;
  glGenTextures(1, &name);
  return GlTexture(name);
}
GlFramebuffer make_framebuffer() {
  GLuint name = 0;
  glGenFramebuffers(1, &name);
  return GlFramebuffer(name);
}
GlSampler make_sampler() {
  GLuint name = 0;
  glGenSamplers(1, &name);
  return GlSampler(name);
}

namespace {

GLuint compile(const char* name, GLenum stage, const std::string& source) {
  const GLuint shader = glCreateShader(stage);
  const char* text = source.c_str();
  glShaderSource(shader, 1, &text, nullptr);
  glCompileShader(shader);
  GLint ok = 0;
  glGetShaderiv(shader, GL_COMPILE_STATUS, &ok);
  if (ok == 0) {
    std::string log(4096, '\0');
    GLsizei length = 0;
    glGetShaderInfoLog(shader, static_cast<GLsizei>(log.size()), &length, log.data());
    log.resize(static_cast<std::size_t>(length));
    throw Error(fmt::format("shader \"{}\" does not compile: {}", name, log));
  }
  return shader;
}

}  // namespace

GlProgram make_program(const char* name, const std::string& vertex, const std::string& fragment) {
  GlProgram program(glCreateProgram());
  for (const auto& [stage, source] :
       {std::pair{GL_VERTEX_SHADER, &vertex}, {GL_FRAGMENT_SHADER, &fragment}}) {
    const GLuint shader = compile(name, static_cast<GLenum>(stage), *source);
    glAttachShader(program.name(), shader);
    glDeleteShader(shader);
  }
  glLinkProgram(program.name());
  GLint ok = 0;
  glGetProgramiv(program.name(), GL_LINK_STATUS, &ok);
  if (ok == 0) throw Error(fmt::format("shader \"{}\" does not link", name));
  return program;
}

void float_attribute(GLuint index, GLint count, std::size_t stride, std::size_t offset,
                     bool per_instance) {
  glEnableVertexAttribArray(index);
  glVertexAttribPointer(index, count, GL_FLOAT, GL_FALSE,
                        static_cast<GLsizei>(stride * sizeof(float)),
                        // OpenGL takes an offset as a pointer.
                        // NOLINTNEXTLINE(performance-no-int-to-ptr)
                        reinterpret_cast<const void*>(offset * sizeof(float)));
  glVertexAttribDivisor(index, per_instance ? 1 : 0);
}

}  // namespace springlod::render
