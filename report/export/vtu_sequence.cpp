#include <cstddef>
#include <iterator>

#include <fmt/format.h>

#include "report/export/motion_files.hpp"
#include "report/export/vtk_grid.hpp"

namespace springlod::report {

namespace {

VtkGrid springs_at(const MassSpringModel& model, const std::vector<Vec3>& x) {
  std::vector<double> strain;
  for (std::uint32_t s = 0; s < model.spring_count(); ++s)
    strain.push_back((x[model.b[s]] - x[model.a[s]]).norm() / model.rest_length[s] - 1);
  VtkGrid grid = vtk_springs(model, x);
  grid.point_data("mass", model.mass);
  grid.cell_data("strain", strain);
  grid.cell_data("stiffness", model.stiffness);
  return grid;
}

}  // namespace

void write_vtu(const ExportedMotion& motion, const MotionOptions&, MotionFiles& files) {
  const ExportedModel& body = motion.body;
  std::string list = fmt::format(
      "<?xml version=\"1.0\"?>\n<!-- {} -->\n<VTKFile type=\"Collection\" version=\"1.0\">\n"
      "<Collection>\n",
      body.origin);
  const auto add = [&](double time, int part, const std::string& ending, const VtkGrid& grid) {
    files.write(ending, grid.file(body.origin));
    fmt::format_to(std::back_inserter(list), "<DataSet timestep=\"{}\" part=\"{}\" file=\"{}\"/>\n",
                   time, part, files.name(ending));
  };
  for (std::size_t f = 0; f < motion.frames.size(); ++f) {
    const sim::Frame& frame = motion.frames[f];
    add(frame.time, 0, "_springs" + frame_suffix(f) + ".vtu", springs_at(body.model, frame.x));
    if (body.surface)
      add(frame.time, 1, "_surface" + frame_suffix(f) + ".vtu",
          vtk_surface(*body.surface, surface_at(body, frame.x)));
  }
  files.write(".pvd", list + "</Collection>\n</VTKFile>\n");
  // The main file is written last, when all that it names is there.
  std::swap(files.report.files.front(), files.report.files.back());
}

}  // namespace springlod::report
