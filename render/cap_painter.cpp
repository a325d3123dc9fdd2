#include "render/cap_painter.hpp"

namespace springlod::render {
namespace {

std::vector<Vec3f> quad_in(const Eigen::Vector4f& plane, const Slot& slot) {
  const Vec3f n = plane.head<3>();
  const Vec3f middle = slot.middle + (plane.w() - n.dot(slot.middle)) * n;
  const Vec3f u = slot.reach * n.unitOrthogonal();
  const Vec3f v = n.cross(u);
  return {middle - u - v, middle + u - v, middle + u + v, middle - u + v};
}

constexpr GLuint kAllBits = 0xFF;

}  // namespace

CapPainter::CapPainter()
    : count_(frame_program("surface depth", surface_depth_shader())),
      cap_(frame_program("cap", cap_shader())) {
  quad_.describe({3}, false);
}

void CapPainter::draw(const Slot& slot) {
  quad_.set(quad_in(slot.cap, slot));
  glEnable(GL_STENCIL_TEST);
  glDepthFunc(GL_LEQUAL);  // the face of a part covers that of a part around it
  for (const CutPart& part : slot.cut_parts) {
    glClear(GL_STENCIL_BUFFER_BIT);
    glUseProgram(count_.name());
    glColorMask(GL_FALSE, GL_FALSE, GL_FALSE, GL_FALSE);
    glDisable(GL_DEPTH_TEST);
    glStencilFunc(GL_ALWAYS, 0, kAllBits);
    glStencilOpSeparate(GL_BACK, GL_KEEP, GL_KEEP, GL_INCR_WRAP);
    glStencilOpSeparate(GL_FRONT, GL_KEEP, GL_KEEP, GL_DECR_WRAP);
    draw_triangles(slot, part.first_triangle, part.triangle_count);
    glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
    glEnable(GL_DEPTH_TEST);
    glStencilFunc(GL_NOTEQUAL, 0, kAllBits);
    glStencilOp(GL_KEEP, GL_KEEP, GL_KEEP);
    glUseProgram(cap_.name());
    set(cap_, "cap_normal", slot.cap.head<3>());
    set(cap_, "cap_colour", Vec3f(part.colour.r, part.colour.g, part.colour.b));
    glBindVertexArray(quad_.layout.name());
    glDrawArrays(GL_TRIANGLE_FAN, 0, quad_.count);
  }
  glDepthFunc(GL_LESS);
  glDisable(GL_STENCIL_TEST);
}

}  // namespace springlod::render
