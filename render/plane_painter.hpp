#pragma once

#include <vector>

#include "render/frame_program.hpp"
#include "render/gpu_slot.hpp"
#include "render/light.hpp"
#include "render/plane.hpp"

namespace springlod::render {

/// What the planes of one panel share.
struct PlaneScene {
  std::vector<PlanePatch> patches;
  float view_radius = 1;  ///< half the height of the view at the target [m]
  KeyLight light;
  bool shaded = true;  ///< anything casts shadows on them
};

/// Draws floors, ramps and walls, and the lines along edges of obstacles, with the `Frame` that is
/// bound.
class PlanePainter {
 public:
  PlanePainter();
  /// The planes whose front the viewer sees, or (`from_behind`) those seen through.
  void draw(const PlaneScene& scene, bool from_behind);
  /// Lines where planes that the viewer faces meet, and `more`, such as the edges of boxes.
  void draw_edges(const PlaneScene& scene, std::vector<SpringInstance> more, float radius);

 private:
  void draw_plane(const PlaneScene& scene, std::size_t which);
  void draw_polygon(const std::vector<Vec3f>& points);

  GlProgram plane_;
  GlProgram shade_;
  GlProgram line_;
  Stream<Vec3f> polygon_;
  Stream<SpringInstance> edges_;
};

}  // namespace springlod::render
