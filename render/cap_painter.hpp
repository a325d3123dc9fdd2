#pragma once

#include "render/frame_program.hpp"
#include "render/gpu_slot.hpp"

namespace springlod::render {

/// Draws the cut faces of a closed body, hatched as a section in an engineering drawing.
///
/// The stencil buffer counts, for each part and pixel, the back faces less the front faces of what
/// is kept. Where they differ, the ray has entered the part through the plane of the cut: there the
/// face is drawn, at the depth of the plane. So faces of bodies that are not convex are right too.
class CapPainter {
 public:
  CapPainter();
  /// Uses the `Frame` that is bound. Needs a stencil buffer.
  void draw(const Slot& slot);

 private:
  GlProgram count_;
  GlProgram cap_;
  Stream<Vec3f> quad_;
};

}  // namespace springlod::render
