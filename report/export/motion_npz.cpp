#include "report/export/motion_files.hpp"
#include "report/export/numpy.hpp"

namespace springlod::report {

void write_motion_npz(const ExportedMotion& motion, const MotionOptions&, MotionFiles& files) {
  std::vector<double> times;
  std::vector<std::vector<Vec3>> nodes, surface;
  for (const sim::Frame& frame : motion.frames) {
    times.push_back(frame.time);
    nodes.push_back(frame.x);
    if (motion.body.surface) surface.push_back(surface_at(motion.body, frame.x));
  }
  NumpyArrays arrays;
  arrays.add("time", times);
  arrays.add("nodes", nodes);
  if (motion.body.surface) {
    std::vector<std::uint32_t> corners;
    for (const Triangle& triangle : motion.body.surface->triangles)
      corners.insert(corners.end(), triangle.begin(), triangle.end());
    arrays.add("surface", surface);
    arrays.add("triangles", corners, 3);
  }
  files.write(".npz", arrays.file());
  files.report.losses.push_back("springs and masses: export the level itself as npz for them");
}

}  // namespace springlod::report
