#include <cstddef>
#include <iterator>

#include <fmt/format.h>

#include "report/export/motion_files.hpp"
#include "report/export/vtu_text.hpp"

namespace springlod::report {

namespace {

VtuGrid springs_at(const MassSpringModel& model, const std::vector<Vec3>& x) {
  VtuGrid grid{.points = x,
               .cell = VtuGrid::Cell::line,
               .corners = {},
               .of_points = {{"mass", model.mass}},
               .of_cells = {{"strain", {}}, {"stiffness", model.stiffness}}};
  std::vector<double>& strain = grid.of_cells.front().second;
  for (std::uint32_t s = 0; s < model.spring_count(); ++s) {
    const std::uint32_t a = model.a[s], b = model.b[s];
    grid.corners.insert(grid.corners.end(), {a, b});
    strain.push_back((x[b] - x[a]).norm() / model.rest_length[s] - 1);
  }
  return grid;
}

VtuGrid surface_grid(const ExportedModel& body, const std::vector<Vec3>& x) {
  VtuGrid grid{.points = surface_at(body, x),
               .cell = VtuGrid::Cell::triangle,
               .corners = {},
               .of_points = {},
               .of_cells = {{"part", {}}}};
  for (std::size_t p = 0; p < body.surface->parts.size(); ++p)
    grid.of_cells.front().second.insert(grid.of_cells.front().second.end(),
                                        body.surface->parts[p].triangle_count,
                                        static_cast<double>(p));
  for (const Triangle& triangle : body.surface->triangles)
    grid.corners.insert(grid.corners.end(), triangle.begin(), triangle.end());
  return grid;
}

}  // namespace

void write_vtu(const ExportedMotion& motion, const MotionOptions&, MotionFiles& files) {
  const ExportedModel& body = motion.body;
  std::string list = fmt::format(
      "<?xml version=\"1.0\"?>\n<!-- {} -->\n<VTKFile type=\"Collection\" version=\"1.0\">\n"
      "<Collection>\n",
      body.origin);
  const auto add = [&](double time, int part, const std::string& ending, const VtuGrid& grid) {
    files.write(ending, vtu_text(grid, body.origin));
    fmt::format_to(std::back_inserter(list), "<DataSet timestep=\"{}\" part=\"{}\" file=\"{}\"/>\n",
                   time, part, files.name(ending));
  };
  for (std::size_t f = 0; f < motion.frames.size(); ++f) {
    const sim::Frame& frame = motion.frames[f];
    add(frame.time, 0, "_springs" + frame_suffix(f) + ".vtu", springs_at(body.model, frame.x));
    if (body.surface)
      add(frame.time, 1, "_surface" + frame_suffix(f) + ".vtu", surface_grid(body, frame.x));
  }
  files.write(".pvd", list + "</Collection>\n</VTKFile>\n");
  // The main file is written last, when all that it names is there.
  std::swap(files.report.files.front(), files.report.files.back());
}

}  // namespace springlod::report
