#include "render/shader_light.hpp"

namespace springlod::render {

const std::string& shader_header() {
  static const std::string kHeader = R"(#version 330 core
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
  return kHeader;
}

// Input and output colours are sRGB; lighting is computed in linear light.
const std::string& shader_light() {
  static const std::string kLighting = R"(
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
  float facing = dot(n, key_light.xyz);
  // A face that the light grazes must not hide itself: its depth in the map changes over the taps,
  // of 2.5 texels, and the filter and rounding of each, of one.
  float lift = 0.3 + 3.5 * sqrt(max(1.0 - facing * facing, 0.0));
  vec3 q = (shadow_projection * vec4(p + n * shadow_size.z * lift, 1.0)).xyz;
  bool away = facing < -0.15;
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
  return kLighting;
}

}  // namespace springlod::render
