#include "render/shaders.hpp"

namespace springlod::render {
namespace {

const std::string kHeader = R"(#version 330 core
layout(std140) uniform Frame {
  mat4 view_projection;    // of this pass
  mat4 shadow_projection;  // to the unit cube of the shadow map
  mat4 from_clip;          // the inverse of the camera's view_projection
  vec4 eye;                // w = 1: position; w = 0: direction of a viewer at infinity
  vec4 key_light;          // direction towards it
  vec4 world_up;
  vec4 camera_right;
  vec4 shadow_size;  // x: side of the shadow map [m], y: its depth [m], z: one texel [m]
  vec4 pixel;        // x: height of a pixel at distance 1, y: reach of ambient occlusion [m]
  vec4 planes[8];    // normal and offset of floors and walls
  vec4 image;        // xy: size of the image [px], z: number of planes
};
vec3 towards_eye(vec3 p) { return normalize(eye.xyz - eye.w * p); }
)";

// Input and output colours are sRGB; lighting is computed in linear light.
const std::string kLighting = R"(
uniform sampler2DShadow shadow_compare;
uniform sampler2D shadow_depth;
uniform sampler2D body_depth;  // as the camera sees the bodies and boxes, at half the resolution

// Ordered dither of +-0.5 of an 8-bit step: smooth shading has no bands, and the pattern repeats
// every 4 pixels, so that PNG still compresses it.
vec3 dithered(vec3 c) {
  ivec2 p = ivec2(gl_FragCoord.xy);
  ivec2 q = p >> 1;
  int rank = ((p.x ^ p.y) & 1) * 8 + (p.y & 1) * 4 + ((q.x ^ q.y) & 1) * 2 + (q.y & 1);
  return c + (float(rank) - 7.5) / (16.0 * 255.0);
}

// Gamma 2 approximates the sRGB curve: the difference is invisible, and pow() would take a third of
// the drawing time.
vec3 to_light(vec3 c) { return c * c; }
vec3 to_display(vec3 c) { return sqrt(clamp(c, 0.0, 1.0)); }
float fourth_power(float x) { x *= x; return x * x; }

// Points of a Vogel spiral, which are evenly distributed in the disc for any count: point i is
// sqrt((i + 0.5) / count) * dir, and dir turns by the golden angle from point to point.
vec2 next_direction(vec2 dir) {
  return vec2(-0.73736888 * dir.x - 0.67549029 * dir.y, 0.67549029 * dir.x - 0.73736888 * dir.y);
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
  vec3 q = (shadow_projection * vec4(p + n * shadow_size.z * 2.0, 1.0)).xyz;
  bool away = dot(n, key_light.xyz) < -0.15;
  int taps = away || !in_shadow_map(q) ? 0 : 6;
  float z = min(q.z, 1.0) - 0.6 * shadow_size.z / shadow_size.y;
  float reach = 2.5 * shadow_size.z / shadow_size.x;
  vec2 dir = vec2(1.0, 0.0);
  float lit = 0.0;
  for (int i = 0; i < taps; ++i) {
    lit += texture(shadow_compare, vec3(q.xy + dir * reach * sqrt((float(i) + 0.5) / 6.0), z));
    dir = next_direction(dir);
  }
  return away ? 0.0 : taps == 0 ? 1.0 : lit / 6.0;
}

// Fraction of the key light that reaches a floor or wall: the penumbra widens with the distance
// from the caster, as for a lamp of finite size (percentage-closer soft shadows, Fernando 2005).
float light_on_plane(vec3 p) {
  vec3 q = (shadow_projection * vec4(p, 1.0)).xyz;
  const float lamp = 0.18;  // diameter of the lamp over its distance
  int seeking = in_shadow_map(q) ? 10 : 0;
  float z = min(q.z, 0.9999);
  float turn = pixel_angle();
  vec2 first = vec2(cos(turn), sin(turn));
  float above = 0.0, found = 0.0;
  float reach = clamp(lamp * 0.25, 0.004, 0.06);
  vec2 dir = first;
  for (int i = 0; i < seeking; ++i) {
    float d = textureLod(shadow_depth, q.xy + dir * reach * sqrt((float(i) + 0.5) / 10.0), 0.0).r;
    float over = step(d, z - 1e-6);
    above += over * (q.z - d);
    found += over;
    dir = next_direction(dir);
  }
  int taps = found > 0.0 ? 16 : 0;
  float radius = clamp(lamp * 0.5 * above / max(found, 1.0) * shadow_size.y / shadow_size.x,
                       1.2 * shadow_size.z / shadow_size.x, 0.06);
  float lit = 0.0;
  dir = first;
  for (int i = 0; i < taps; ++i) {
    lit += texture(shadow_compare, vec3(q.xy + dir * radius * sqrt((float(i) + 0.5) / 16.0), z));
    dir = next_direction(dir);
  }
  return taps == 0 ? 1.0 : lit / 16.0;
}

// Fraction of the ambient light that bodies and boxes leave to a point (scalable ambient
// obscurance, McGuire et al. 2012), from their depths in the picture.
float open_to_bodies(vec3 p, vec3 n) {
  const int taps = 8;
  float reach = pixel.y;
  vec4 at = view_projection * vec4(p, 1.0);
  float radius = reach / (at.w * pixel.x * image.y);  // in heights of the image
  vec2 scale = vec2(image.y / image.x, 1.0) * radius;
  vec2 middle = at.xy / at.w * 0.5 + 0.5;
  float turn = pixel_angle();
  vec2 dir = vec2(cos(turn), sin(turn));
  float hidden = 0.0;
  for (int i = 0; i < taps; ++i) {
    vec2 where = middle + dir * scale * ((float(i) + 0.5) / float(taps));
    float z = textureLod(body_depth, where, 0.0).r;
    vec4 q = from_clip * vec4(vec3(where, z) * 2.0 - 1.0, 1.0);
    vec3 v = q.xyz / q.w - p;
    float d = dot(v, v) / (reach * reach);
    float fall = max(1.0 - d, 0.0);
    hidden += fall * fall * max(dot(v, n) / reach - 0.06, 0.0) / (sqrt(d) + 0.1);
    dir = next_direction(dir);
  }
  return clamp(1.0 - 2.4 * hidden / float(taps), 0.0, 1.0);
}

// The same of floors and walls, which are planes: the part of the hemisphere that they fill.
float open_to_planes(vec3 p, vec3 n) {
  float open = 1.0;
  for (int i = 0; i < int(image.z); ++i) {
    float height = dot(planes[i].xyz, p) - planes[i].w;
    float near = 1.0 - smoothstep(0.0, 2.0 * pixel.y, height);
    open *= 1.0 - 0.55 * near * (0.5 - 0.5 * dot(n, planes[i].xyz));
  }
  return open;
}
float open_sky(vec3 p, vec3 n) { return open_to_bodies(p, n) * open_to_planes(p, n); }

// Studio lighting: ambient light from above, reflection from a pale floor, a key light, a fill
// light from the viewer's side, a soft highlight and a pale rim.
vec3 studio(vec3 srgb, vec3 n, vec3 p, float key, float open) {
  vec3 albedo = to_light(srgb);
  vec3 v = towards_eye(p);
  vec3 l = key_light.xyz;
  float sky = 0.5 + 0.5 * dot(n, world_up.xyz);
  vec3 ambient = mix(vec3(0.33, 0.32, 0.31), vec3(0.50, 0.52, 0.55), sky);
  float wrapped = max((dot(n, l) + 0.15) / 1.15, 0.0);
  vec3 direct = vec3(0.80, 0.78, 0.75) * wrapped * key;
  vec3 fill = vec3(0.12) * max(dot(n, v), 0.0);
  // Light bounces in creases, so that they keep a tint of the body.
  vec3 occluded = mix(vec3(open), vec3(1.0), 0.35 * albedo * (1.0 - open));
  vec3 colour = albedo * ((ambient + fill) * occluded + direct * mix(0.6, 1.0, open));
  float facing = max(dot(n, v), 0.0);
  float tight = fourth_power(fourth_power(max(dot(n, normalize(l + v)), 0.0)));  // ^16
  colour += 0.16 * tight * tight * tight * key + 0.10 * fourth_power(1.0 - facing) * sky * open;
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
layout(location = 3) in float inside_in;  // distance from the cut at rest [m], below 0: cut away
out vec3 position;
out vec3 normal;
out vec3 colour;
out float inside;
void main() {
  inside = inside_in;
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

namespace {

// Lights a point of a surface.
const std::string kSurfaceLight = R"(
uniform float opacity;
in vec3 position;
in vec3 normal;
in vec3 colour;
in float inside;
out vec4 result;
vec4 lit_surface(vec3 c, vec3 n, vec3 p) {
  float key = opacity < 1.0 ? 1.0 : light_on_body(p, n);
  // Transparent surfaces are more opaque at grazing angles.
  float edge = 1.0 - abs(dot(n, towards_eye(p)));
  float alpha = opacity < 1.0 ? mix(opacity, min(1.0, opacity + 0.45), edge * edge * edge) : 1.0;
  float open = opacity < 1.0 ? 1.0 : open_sky(p, n);
  return vec4(dithered(to_display(studio(c, n, p, key, open))), alpha);
}
)";

}  // namespace

ShaderSource surface_shader() {
  return {kHeader + kSurfaceVertex, kHeader + kLighting + kSurfaceLight + R"(
void main() {
  vec3 n = normalize(normal);
  result = lit_surface(colour, gl_FrontFacing ? n : -n, position);
}
)"};
}

ShaderSource cut_surface_shader() {
  return {kHeader + kSurfaceVertex, kHeader + kLighting + kSurfaceLight + R"(
uniform vec4 cap;  // plane of the cut face, its normal out of the body; zero: no cut face is drawn
void main() {
  if (inside < 0.0) discard;
  vec3 p = position;
  vec3 n = normalize(normal);
  vec3 c = colour;
  gl_FragDepth = gl_FragCoord.z;
  if (!gl_FrontFacing) {
    n = -n;
    // A ray that meets the inner side first has passed the cut face: this pixel shows that face.
    vec3 ray = position - eye.xyz;
    float along = dot(cap.xyz, ray);
    if (along < 0.0) {
      p = eye.xyz + ray * (cap.w - dot(cap.xyz, eye.xyz)) / along;
      n = cap.xyz;
      vec4 clip = view_projection * vec4(p, 1.0);
      // The inner of two nested parts, whose back is nearer, wins.
      gl_FragDepth = mix(clip.z / clip.w * 0.5 + 0.5, gl_FragCoord.z, 1e-3);
      // Hatched, as a section in an engineering drawing.
      float stripe = abs(fract((gl_FragCoord.x + gl_FragCoord.y) / 11.0) - 0.5) * 11.0;
      c = mix(mix(c, vec3(1.0), 0.30), c * 0.92, 1.0 - smoothstep(0.4, 1.4, stripe));
    }
  }
  result = lit_surface(c, n, p);
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
uniform float plane_slope;  // 1: a ramp, marked by arrows that point downhill
uniform float grid_spacing;
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

// Arrow heads in every second cell of the grid.
float arrows() {
  vec2 cell = fract(grid / grid_spacing / 2.0) - 0.5;
  float away = abs(cell.y + 0.08 - 0.5 * abs(cell.x)) ;
  float soft = fwidth(grid.y / grid_spacing / 2.0);
  return (1.0 - smoothstep(0.014 - soft, 0.014 + soft, away)) * step(abs(cell.x), 0.10) *
         (1.0 - smoothstep(0.03, 0.12, soft));
}

void main() {
  float fade = 1.0 - smoothstep(0.35, 1.0, length(from_center));
  float minor = lines(grid_spacing, grid_spacing * 0.010);
  float major = lines(grid_spacing * 5.0, grid_spacing * 0.024);
  float drawn = max(minor * 0.75, major);
  if (plane_slope > 0.0) drawn = max(drawn, 0.9 * arrows());
  result = vec4(plane_colour * (1.0 - 0.13 * drawn), fade * plane_alpha);
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
out float inside;
void main() {
  inside = inside_in;
  gl_Position = view_projection * vec4(position_in, 1.0);
}
)",
          kHeader + R"(
in float inside;
void main() {
  if (inside < 0.0) discard;
}
)"};
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
