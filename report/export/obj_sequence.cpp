#include "report/export/draft.hpp"
#include "report/export/motion_files.hpp"
#include "report/export/obj_text.hpp"

namespace springlod::report {

void write_obj_sequence(const ExportedMotion& motion, const MotionOptions&, MotionFiles& files) {
  require_surface(motion.body, "obj");
  for (std::size_t f = 0; f < motion.frames.size(); ++f)
    files.write(frame_suffix(f) + ".obj",
                obj_text(motion.body, surface_at(motion.body, motion.frames[f].x)));
  files.report.losses.push_back("nodes, springs, masses and the times of the frames");
}

}  // namespace springlod::report
