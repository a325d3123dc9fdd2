#pragma once

#include <string>

namespace springlod::render {

/// Start of every shader: the version, the uniform block `Frame` and towards_eye().
const std::string& shader_header();
/// Functions of fragment shaders: shadows, ambient occlusion, studio light and dither.
const std::string& shader_light();

}  // namespace springlod::render
