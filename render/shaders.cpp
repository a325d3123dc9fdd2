#include "render/shaders.hpp"

#include "render/shader_light.hpp"

namespace springlod::render {
namespace {

const std::string& kHeader = shader_header();
const std::string& kLighting = shader_light();

const std::string kSpringVertex = R"(
layout(location = 0) in vec3 end_a;
layout(location = 1) in vec3 end_b;
layout(location = 2) in vec3 colour_a;
layout(location = 3) in vec3 colour_b;
layout(location = 4) in float radius;
out vec3 position;
out vec3 colour;
out vec3 across;
out vec3 outward;
out float side;
void main() {
  float t = float(gl_VertexID >> 1);
  side = float(gl_VertexID & 1) * 2.0 - 1.0;
  vec3 p = mix(end_a, end_b, t);
  vec3 view = towards_eye(p);
  vec3 axis = end_b - end_a;
  across = normalize(cross(axis, view));
  outward = normalize(cross(across, axis));
  if (dot(outward, view) < 0.0) outward = -outward;
  // At least about one pixel wide: thinner lines alias.
  float least = eye.w * 0.55 * pixel.x * distance(eye.xyz, p);
  position = p + across * side * max(radius, least);
  colour = mix(colour_a, colour_b, t);
  gl_Position = view_projection * vec4(position, 1.0);
}
)";

const std::string kNodeVertex = R"(
layout(location = 0) in vec3 center;
layout(location = 1) in vec3 colour_in;
layout(location = 2) in float radius_in;
out vec3 ball_center;
out vec3 colour;
out vec3 axis_x;
out vec3 axis_y;
out vec3 axis_z;
out vec2 at;
out float radius;
void main() {
  // 1.15: the quad includes the partly covered pixels at the edge.
  at = (vec2(gl_VertexID & 1, gl_VertexID >> 1) * 2.0 - 1.0) * 1.15;
  axis_z = towards_eye(center);
  axis_y = normalize(cross(axis_z, camera_right.xyz));
  axis_x = cross(axis_y, axis_z);
  float least = eye.w * 0.9 * pixel.x * distance(eye.xyz, center);
  radius = max(radius_in, least);
  ball_center = center;
  colour = colour_in;
  gl_Position = view_projection * vec4(center + radius * (axis_x * at.x + axis_y * at.y), 1.0);
}
)";

const std::string kNodeInputs = R"(
in vec3 ball_center;
in vec3 colour;
in vec3 axis_x;
in vec3 axis_y;
in vec3 axis_z;
in vec2 at;
in float radius;
vec3 ball_normal() {
  return axis_x * at.x + axis_y * at.y + axis_z * sqrt(max(1.0 - dot(at, at), 0.0));
}
float ball_depth(vec3 n) {
  vec4 clip = view_projection * vec4(ball_center + n * radius, 1.0);
  return clip.z / clip.w * 0.5 + 0.5;
}
)";

const std::string kSurfaceVertex = R"(
layout(location = 0) in vec3 position_in;
layout(location = 1) in vec3 normal_in;
layout(location = 2) in vec3 colour_in;
layout(location = 3) in float inside_in;  // distance from the cut at rest [m], below 0: cut away
out vec3 position;
out vec3 normal;
out vec3 colour;
void main() {
  gl_ClipDistance[0] = inside_in;  // counts only for bodies that are cut
  position = position_in;
  normal = normal_in;
  colour = colour_in;
  gl_Position = view_projection * vec4(position_in, 1.0);
}
)";

const std::string kPlaneVertex = R"(
layout(location = 0) in vec3 position_in;
uniform vec3 plane_center;
uniform vec3 plane_u;
uniform vec3 plane_v;
uniform float plane_reach;
uniform vec2 grid_origin;  // position of plane_center on the grid [m]
out vec3 position;
out vec2 grid;
out vec2 from_center;
void main() {
  vec3 r = position_in - plane_center;
  vec2 at = vec2(dot(r, plane_u), dot(r, plane_v));
  position = position_in;
  from_center = at / plane_reach;
  grid = grid_origin + at;
  gl_Position = view_projection * vec4(position_in, 1.0);
}
)";

const std::string kNothing = "void main() {}\n";

}  // namespace

ShaderSource backdrop_shader() {
  return {kHeader + R"(
out float height;
void main() {
  vec2 p = vec2((gl_VertexID << 1) & 2, gl_VertexID & 2) * 2.0 - 1.0;
  height = p.y * 0.5 + 0.5;
  gl_Position = vec4(p, 0.0, 1.0);
}
)",
          kHeader + kLighting + R"(
in float height;
out vec4 result;
void main() {
  vec3 low = vec3(0.972, 0.975, 0.980);
  vec3 high = vec3(0.835, 0.868, 0.905);
  result = vec4(dithered(mix(low, high, smoothstep(0.25, 1.1, height))), 1.0);
}
)"};
}

ShaderSource surface_shader() {
  return {kHeader + kSurfaceVertex, kHeader + kLighting + R"(
uniform float opacity;
in vec3 position;
in vec3 normal;
in vec3 colour;
out vec4 result;
void main() {
  vec3 n = normalize(gl_FrontFacing ? normal : -normal);
  float key = opacity < 1.0 ? 1.0 : light_on_body(position, n);
  // Transparent surfaces are more opaque at grazing angles.
  float edge = 1.0 - abs(dot(n, towards_eye(position)));
  float alpha = opacity < 1.0 ? mix(opacity, min(1.0, opacity + 0.45), edge * edge * edge) : 1.0;
  float open = opacity < 1.0 ? 1.0 : open_sky(position, n);
  result = vec4(dithered(to_display(studio(colour, n, position, key, open))), alpha);
}
)"};
}

ShaderSource cap_shader() {
  return {kHeader + R"(
layout(location = 0) in vec3 position_in;
out vec3 position;
void main() {
  position = position_in;
  gl_Position = view_projection * vec4(position_in, 1.0);
}
)",
          kHeader + kLighting + R"(
uniform vec3 cap_normal;
uniform vec3 cap_colour;
in vec3 position;
out vec4 result;
void main() {
  float stripe = abs(fract((gl_FragCoord.x + gl_FragCoord.y) / 11.0) - 0.5) * 11.0;
  float line = 1.0 - smoothstep(0.4, 1.4, stripe);
  vec3 c = mix(mix(cap_colour, vec3(1.0), 0.30), cap_colour * 0.92, line);
  float key = light_on_body(position, cap_normal);
  float open = open_sky(position, cap_normal);
  result = vec4(dithered(to_display(studio(c, cap_normal, position, key, open))), 1.0);
}
)"};
}

ShaderSource spring_shader() {
  return {kHeader + kSpringVertex, kHeader + kLighting + R"(
in vec3 position;
in vec3 colour;
in vec3 across;
in vec3 outward;
in float side;
out vec4 result;
void main() {
  vec3 n = normalize(across * side * 0.9 + outward * sqrt(max(1.0 - side * side * 0.81, 0.0)));
  float key = light_on_body(position, n);
  result = vec4(to_display(studio(colour, n, position, 0.35 + 0.65 * key, open_sky(position, n))), 1.0);
}
)"};
}

ShaderSource line_shader() {
  return {kHeader + kSpringVertex, kHeader + R"(
in vec3 colour;
out vec4 result;
void main() { result = vec4(colour, 1.0); }
)"};
}

ShaderSource node_shader() {
  return {kHeader + kNodeVertex, kHeader + kLighting + kNodeInputs + R"(
out vec4 result;
void main() {
  float r = length(at);
  float cover = clamp((1.0 - r) / fwidth(r) + 0.5, 0.0, 1.0);
  if (cover <= 0.0) discard;
  vec3 n = normalize(ball_normal());
  gl_FragDepth = ball_depth(n);
  vec3 p = ball_center + n * radius;
  float key = light_on_body(p, n);
  // Alpha to coverage: smooth edges with correct depth test.
  result = vec4(to_display(studio(colour, n, p, 0.35 + 0.65 * key, open_sky(p, n))), cover);
}
)"};
}

ShaderSource plane_shader() {
  return {kHeader + kPlaneVertex, kHeader + R"(
uniform vec3 plane_colour;
uniform float plane_alpha;
uniform float grid_spacing;   // [m]
uniform float arrow_spacing;  // of the arrows that point down a ramp [m]; 0: no ramp
in vec2 grid;
in vec2 from_center;
out vec4 result;

// Fraction of the pixel covered by lines of `width` [m] every `spacing` [m]. Lines thinner than a
// pixel fade, which prevents flicker.
float lines(float spacing, float width) {
  vec2 uv = grid / spacing;
  vec2 soft = fwidth(uv);
  vec2 half_width = vec2(width / spacing * 0.5);
  vec2 drawn = max(half_width, soft * 0.6);
  vec2 away = abs(fract(uv - 0.5) - 0.5);
  vec2 line = (1.0 - smoothstep(drawn - soft * 0.6, drawn + soft * 0.6, away)) * min(half_width / drawn + 0.35, 1.0);
  line *= 1.0 - smoothstep(0.15, 0.5, soft);
  return max(line.x, line.y);
}

// Coverage by arrows that point to -v. Distances from the outline are in cells of the arrows.
float arrows() {
  vec2 at = grid / arrow_spacing;
  vec2 cell = fract(at) - 0.5;
  float soft = max(length(fwidth(at)), 1e-4);
  float x = abs(cell.x);
  float head = max(0.8 * x - 0.6 * (cell.y + 0.26), cell.y + 0.04);
  float shaft = max(x - 0.04, abs(cell.y - 0.105) - 0.155);
  float away = min(head, shaft);
  return clamp(0.5 - away / soft, 0.0, 1.0) * (1.0 - smoothstep(0.08, 0.3, soft));
}

void main() {
  float fade = 1.0 - smoothstep(0.35, 1.0, length(from_center));
  float minor = lines(grid_spacing, grid_spacing * 0.010);
  float major = lines(grid_spacing * 5.0, grid_spacing * 0.024);
  float drawn = max(minor * 0.75, major);
  vec3 c = plane_colour * (1.0 - 0.13 * drawn);
  if (arrow_spacing > 0.0) c = mix(c, vec3(0.62, 0.47, 0.28), 0.55 * arrows());
  result = vec4(c, fade * plane_alpha);
}
)"};
}

ShaderSource plane_shade_shader() {
  return {kHeader + kPlaneVertex, kHeader + kLighting + R"(
uniform vec3 plane_normal;
in vec3 position;
in vec2 from_center;
out vec4 result;
void main() {
  float fade = 1.0 - smoothstep(0.35, 1.0, length(from_center));
  float open = open_to_bodies(position, plane_normal);
  vec3 shade = mix(vec3(0.60, 0.62, 0.66), vec3(1.0), light_on_plane(position));
  shade *= mix(vec3(0.50, 0.52, 0.55), vec3(1.0), open);
  result = vec4(dithered(mix(vec3(1.0), shade, fade)), 1.0);
}
)"};
}

ShaderSource surface_depth_shader() {
  return {kHeader + R"(
layout(location = 0) in vec3 position_in;
layout(location = 3) in float inside_in;
void main() {
  gl_ClipDistance[0] = inside_in;
  gl_Position = view_projection * vec4(position_in, 1.0);
}
)",
          kHeader + kNothing};
}

ShaderSource spring_depth_shader() {
  return {kHeader + kSpringVertex, kHeader + kNothing};
}

ShaderSource node_depth_shader() {
  return {kHeader + kNodeVertex, kHeader + kNodeInputs + R"(
void main() {
  if (dot(at, at) > 1.0) discard;
  gl_FragDepth = ball_depth(ball_normal());
}
)"};
}

}  // namespace springlod::render
