#include "render/shaders.hpp"

namespace springlod::render {
namespace {

const std::string kHeader = R"(#version 330 core
layout(std140) uniform Frame {
  mat4 view_projection;    // of this pass
  mat4 shadow_projection;  // to the unit cube of the shadow map
  vec4 eye;                // w = 1: position; w = 0: direction of a viewer at infinity
  vec4 key_light;          // direction towards it
  vec4 world_up;
  vec4 camera_right;
  vec4 shadow_size;  // x: side of the shadow map [m], y: its depth [m], z: one texel [m]
  vec4 pixel;        // x: height of a pixel at distance 1
};
vec3 towards_eye(vec3 p) { return normalize(eye.xyz - eye.w * p); }
)";

// Input and output colours are sRGB; lighting is computed in linear light.
const std::string kLighting = R"(
uniform sampler2DShadow shadow_compare;
uniform sampler2D shadow_depth;

// Gamma 2 approximates the sRGB curve: the difference is invisible, and pow() would take a third of
// the drawing time.
vec3 to_light(vec3 c) { return c * c; }
vec3 to_display(vec3 c) { return sqrt(clamp(c, 0.0, 1.0)); }
float fourth_power(float x) { x *= x; return x * x; }

// Vogel spiral: evenly distributed points in the disc for any count.
vec2 disc_point(int i, int count, float turn) {
  float a = float(i) * 2.39996323 + turn;
  return sqrt((float(i) + 0.5) / float(count)) * vec2(cos(a), sin(a));
}

bool in_shadow_map(vec3 q) {
  return all(greaterThan(q.xy, vec2(0.0))) && all(lessThan(q.xy, vec2(1.0)));
}

// An angle that differs between neighbouring pixels (interleaved gradient noise, Jimenez 2014). It
// replaces banding by fine noise.
float pixel_angle() {
  return 6.2831853 * fract(52.9829189 * fract(dot(floor(gl_FragCoord.xy), vec2(0.06711056, 0.00583715))));
}

// Fraction of the key light that reaches a body; the shadow edge is narrow and soft.
float light_on_body(vec3 p, vec3 n) {
  if (dot(n, key_light.xyz) < -0.15) return 0.0;  // facing away from the light
  vec3 q = (shadow_projection * vec4(p + n * shadow_size.z * 2.0, 1.0)).xyz;
  if (!in_shadow_map(q)) return 1.0;
  float z = min(q.z, 1.0) - 0.6 * shadow_size.z / shadow_size.y;
  float lit = 0.0;
  for (int i = 0; i < 6; ++i)
    lit += texture(shadow_compare, vec3(q.xy + disc_point(i, 6, 0.0) * 2.5 * shadow_size.z / shadow_size.x, z));
  return lit / 6.0;
}

// Fraction of the key light that reaches a floor or wall: the penumbra widens with the distance
// from the caster, as for a lamp of finite size (percentage-closer soft shadows, Fernando 2005).
float light_on_plane(vec3 p) {
  vec3 q = (shadow_projection * vec4(p, 1.0)).xyz;
  if (!in_shadow_map(q)) return 1.0;
  const float lamp = 0.18;  // diameter of the lamp over its distance
  const int seeking = 10;
  float turn = pixel_angle();
  float above = 0.0, found = 0.0;
  float reach = clamp(lamp * 0.25, 0.004, 0.06);
  for (int i = 0; i < seeking; ++i) {
    float d = textureLod(shadow_depth, q.xy + disc_point(i, seeking, turn) * reach, 0.0).r;
    if (d < min(q.z, 0.9999)) { above += q.z - d; found += 1.0; }
  }
  if (found == 0.0) return 1.0;
  float radius = clamp(lamp * 0.5 * above / found * shadow_size.y / shadow_size.x,
                       1.2 * shadow_size.z / shadow_size.x, 0.06);
  const int taps = 16;
  float z = min(q.z, 0.9999);
  float lit = 0.0;
  for (int i = 0; i < taps; ++i)
    lit += texture(shadow_compare, vec3(q.xy + disc_point(i, taps, turn) * radius, z));
  return lit / float(taps);
}

// Studio lighting: ambient light from above, reflection from a pale floor, a key light, a fill
// light from the viewer's side, a soft highlight and a pale rim.
vec3 studio(vec3 srgb, vec3 n, vec3 p, float key) {
  vec3 albedo = to_light(srgb);
  vec3 v = towards_eye(p);
  vec3 l = key_light.xyz;
  float sky = 0.5 + 0.5 * dot(n, world_up.xyz);
  vec3 ambient = mix(vec3(0.33, 0.32, 0.31), vec3(0.50, 0.52, 0.55), sky);
  float wrapped = max((dot(n, l) + 0.15) / 1.15, 0.0);
  vec3 direct = vec3(0.80, 0.78, 0.75) * wrapped * key;
  vec3 fill = vec3(0.12) * max(dot(n, v), 0.0);
  vec3 colour = albedo * (ambient + direct + fill);
  float facing = max(dot(n, v), 0.0);
  float tight = fourth_power(fourth_power(max(dot(n, normalize(l + v)), 0.0)));  // ^16
  colour += 0.16 * tight * tight * tight * key + 0.10 * fourth_power(1.0 - facing) * sky;
  return colour;
}
)";

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
out vec3 position;
out vec3 normal;
out vec3 colour;
void main() {
  position = position_in;
  normal = normal_in;
  colour = colour_in;
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
          kHeader + R"(
in float height;
out vec4 result;
void main() {
  vec3 low = vec3(0.972, 0.975, 0.980);
  vec3 high = vec3(0.835, 0.868, 0.905);
  result = vec4(mix(low, high, smoothstep(0.25, 1.1, height)), 1.0);
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
  vec3 n = normalize(normal);
  if (!gl_FrontFacing) n = -n;
  float key = opacity < 1.0 ? 1.0 : light_on_body(position, n);
  // Transparent surfaces are more opaque at grazing angles.
  float edge = pow(1.0 - abs(dot(n, towards_eye(position))), 3.0);
  float alpha = opacity < 1.0 ? mix(opacity, min(1.0, opacity + 0.45), edge) : 1.0;
  result = vec4(to_display(studio(colour, n, position, key)), alpha);
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
  result = vec4(to_display(studio(colour, n, position, 0.35 + 0.65 * key)), 1.0);
}
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
  float key = light_on_body(ball_center + n * radius, n);
  // Alpha to coverage: smooth edges with correct depth test.
  result = vec4(to_display(studio(colour, n, ball_center + n * radius, 0.35 + 0.65 * key)), cover);
}
)"};
}

ShaderSource plane_shader() {
  return {kHeader + R"(
uniform vec3 plane_center;
uniform vec3 plane_u;
uniform vec3 plane_v;
uniform float plane_reach;
uniform vec2 grid_origin;  // position of plane_center on the grid [m]
out vec3 position;
out vec2 grid;
out vec2 from_center;
void main() {
  from_center = vec2(gl_VertexID & 1, gl_VertexID >> 1) * 2.0 - 1.0;
  vec2 at = from_center * plane_reach;
  grid = grid_origin + at;
  position = plane_center + plane_u * at.x + plane_v * at.y;
  gl_Position = view_projection * vec4(position, 1.0);
}
)",
          kHeader + kLighting + R"(
uniform vec3 plane_colour;
uniform float plane_alpha;
uniform float grid_spacing;
uniform int other_count;
uniform vec4 others[8];  // normal and offset of the other planes, which hide what is behind them
in vec3 position;
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

void main() {
  for (int i = 0; i < other_count; ++i)
    if (dot(others[i].xyz, position) < others[i].w) discard;
  float fade = 1.0 - smoothstep(0.35, 1.0, length(from_center));
  float key = light_on_plane(position);
  float minor = lines(grid_spacing, grid_spacing * 0.010);
  float major = lines(grid_spacing * 5.0, grid_spacing * 0.024);
  vec3 colour = plane_colour * (1.0 - 0.13 * max(minor * 0.75, major));
  colour *= mix(vec3(0.60, 0.62, 0.66), vec3(1.0), key);
  result = vec4(colour, fade * plane_alpha);
}
)"};
}

ShaderSource surface_depth_shader() {
  return {kHeader + R"(
layout(location = 0) in vec3 position_in;
void main() { gl_Position = view_projection * vec4(position_in, 1.0); }
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
