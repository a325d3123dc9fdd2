#include "render/plane_painter.hpp"

namespace springlod::render {
namespace {

constexpr Colour kFloorColour{0.935F, 0.938F, 0.942F};
constexpr Colour kRampColour{0.935F, 0.905F, 0.850F};
constexpr Colour kWallColour{0.850F, 0.880F, 0.915F};
constexpr float kGhost = 0.16F;  // opacity of a wall between the viewer and the bodies

Vec3f colour_of(PlanePatch::Kind kind) {
  const Colour& c = kind == PlanePatch::Kind::floor  ? kFloorColour
                    : kind == PlanePatch::Kind::ramp ? kRampColour
                                                     : kWallColour;
  return {c.r, c.g, c.b};
}

void set_patch(const GlProgram& of, const PlanePatch& patch) {
  glUseProgram(of.name());
  set(of, "plane_center", patch.center);
  set(of, "plane_u", patch.u);
  set(of, "plane_v", patch.v);
  set(of, "plane_reach", patch.reach);
  glUniform2fv(uniform(of, "grid_origin"), 1, patch.grid_origin.data());
}

}  // namespace

PlanePainter::PlanePainter()
    : plane_(frame_program("plane", plane_shader())),
      shade_(frame_program("plane shade", plane_shade_shader())),
      line_(frame_program("line", line_shader())) {
  polygon_.describe({3}, false);
  edges_.describe({3, 3, 3, 3, 1}, true);
}

void PlanePainter::draw_polygon(const std::vector<Vec3f>& points) {
  if (points.empty()) return;
  polygon_.set(points);
  glBindVertexArray(polygon_.layout.name());
  glDrawArrays(GL_TRIANGLE_FAN, 0, polygon_.count);
}

void PlanePainter::draw_plane(const PlaneScene& scene, std::size_t which) {
  const PlanePatch& patch = scene.patches[which];
  const bool ramp = patch.kind == PlanePatch::Kind::ramp;
  set_patch(plane_, patch);
  set(plane_, "plane_colour", colour_of(patch.kind));
  set(plane_, "plane_alpha", patch.seen_from_behind ? kGhost : 1.0F);
  set(plane_, "grid_spacing", static_cast<float>(grid_spacing(scene.view_radius)));
  set(plane_, "arrow_spacing", ramp ? static_cast<float>(arrow_spacing(scene.view_radius)) : 0.0F);
  const std::vector<Vec3f> points = visible_polygon(scene.patches, which);
  draw_polygon(points);
  if (patch.seen_from_behind || !scene.shaded) return;
  // Shadows cost several times what the rest of a plane does, so they multiply its colour in a
  // second pass over the part that can have any.
  set_patch(shade_, patch);
  set(shade_, "plane_normal", patch.normal);
  glBlendFunc(GL_DST_COLOR, GL_ZERO);
  glDepthMask(GL_FALSE);
  glEnable(GL_POLYGON_OFFSET_FILL);
  glPolygonOffset(-1, -4);
  draw_polygon(shaded_part(points, scene.light.to_unit_cube));
  glDisable(GL_POLYGON_OFFSET_FILL);
  glDepthMask(GL_TRUE);
  glBlendFunc(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA);
}

void PlanePainter::draw(const PlaneScene& scene, bool from_behind) {
  glEnable(GL_BLEND);
  glDepthMask(from_behind ? GL_FALSE : GL_TRUE);
  for (std::size_t i = 0; i < scene.patches.size(); ++i)
    if (scene.patches[i].seen_from_behind == from_behind) draw_plane(scene, i);
  glDepthMask(GL_TRUE);
  glDisable(GL_BLEND);
}

void PlanePainter::draw_edges(const PlaneScene& scene, std::vector<SpringInstance> more,
                              float radius) {
  for (std::size_t i = 0; i < scene.patches.size(); ++i) {
    if (scene.patches[i].seen_from_behind) continue;
    const std::vector<SpringInstance> lines = plane_edges(scene.patches, i, radius);
    more.insert(more.end(), lines.begin(), lines.end());
  }
  edges_.set(more);
  glUseProgram(line_.name());
  // In front of the surfaces that meet there.
  glEnable(GL_POLYGON_OFFSET_FILL);
  glPolygonOffset(-1, -16);
  draw_quads(edges_);
  glDisable(GL_POLYGON_OFFSET_FILL);
}

}  // namespace springlod::render
