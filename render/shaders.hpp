#pragma once

#include <string>

namespace springlod::render {

/// GLSL 3.30 sources. All shaders use the uniform block `Frame` (render/pipeline.cpp) and
/// coordinates in metres relative to the camera's target.
struct ShaderSource {
  std::string vertex;
  std::string fragment;
};

ShaderSource backdrop_shader();  ///< soft vertical gradient behind everything
ShaderSource surface_shader();   ///< shaded triangles: position, normal, colour, cut
ShaderSource cap_shader();       ///< hatched face of a cut
ShaderSource spring_shader();    ///< one instance per spring: a strip shaded as a rod
ShaderSource line_shader();      ///< the same strip in plain colour: edges of obstacles
ShaderSource node_shader();      ///< one instance per node: a quad shaded as a ball
ShaderSource plane_shader();     ///< floor, ramp or wall: grid, fading with distance
/// Factor of the colour of a plane: shadow and ambient occlusion, where bodies can cause any.
ShaderSource plane_shade_shader();

// The same shapes seen from the key light: depth only.
ShaderSource surface_depth_shader();
ShaderSource spring_depth_shader();
ShaderSource node_depth_shader();

}  // namespace springlod::render
