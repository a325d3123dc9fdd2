#pragma once

#include "render/camera.hpp"
#include "render/gl.hpp"
#include "render/shaders.hpp"

namespace springlod::render {

/// Texture units of the samplers of the lighting.
enum class LightMap : GLuint { shadow_compare = 0, shadow_depth = 1, body_depth = 2 };

/// A program whose block `Frame` is at binding 0, with its samplers at the units of LightMap.
GlProgram frame_program(const char* name, const ShaderSource& source);

GLint uniform(const GlProgram& of, const char* name);
// Sets a uniform of the program in use, which must be `of`.
void set(const GlProgram& of, const char* name, const Vec3f& v);
void set(const GlProgram& of, const char* name, float v);

}  // namespace springlod::render
