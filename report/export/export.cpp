#include "report/export/export.hpp"

#include <cctype>

#include <fmt/format.h>

#include "base/file.hpp"
#include "report/export/draft.hpp"

namespace springlod::report {

namespace {

constexpr ModelFormatChoice kFormats[] = {
    {{ModelFormat::jolt, "jolt",
      "Jolt Physics: code that builds its soft body, in C++ and JavaScript"},
     draft_jolt},
    {{ModelFormat::mujoco, "mujoco", "MuJoCo: MJCF with a tendon for each spring"}, draft_mujoco},
    {{ModelFormat::bullet, "bullet", "Bullet: C++ code that builds its soft body"}, draft_bullet},
    {{ModelFormat::newton, "newton", "arrays for Newton (Warp), and NAME.py that reads them"},
     draft_newton},
    {{ModelFormat::sofa, "sofa", "scenes for SOFA: springs, and tetrahedra of a base of cells"},
     draft_sofa},
    {{ModelFormat::msh, "msh", "Gmsh: springs, and tetrahedra with E, nu and density"}, draft_msh},
    {{ModelFormat::vtk, "vtk", "VTK and ParaView: springs, tetrahedra and surface with all values"},
     draft_vtk},
    {{ModelFormat::usda, "usda", "USD: the surface, and nodes and springs as guides"}, draft_usda},
    {{ModelFormat::obj, "obj", "the surface as the level holds it, or the springs as lines"},
     draft_obj},
    {{ModelFormat::npz, "npz", "all arrays of the level for numpy, in full precision"}, draft_npz},
    {{ModelFormat::json, "json", "all arrays of the level, in full precision"}, draft_json},
};

// The path without the ending of one of the files that will be written.
std::string stem_of(const std::string& path, const std::vector<ExportFile>& files) {
  for (const ExportFile& file : files)
    if (file.ending.starts_with('.') && path.ends_with(file.ending))
      return path.substr(0, path.size() - file.ending.size());
  return path;
}

}  // namespace

ChoiceTable<ModelFormatChoice> choices(ModelFormat) {
  return {"model_format", kFormats};
}

ExportReport export_model(const ExportedModel& body, ModelFormat format,
                          const std::filesystem::path& path) {
  const ModelFormatChoice& row = choice_of(format);
  ExportDraft draft = row.write(body);
  const std::string stem = stem_of(path.string(), draft.files);
  ExportReport report{
      .files = {}, .settings = std::move(draft.settings), .losses = std::move(draft.losses)};
  for (const ExportFile& file : draft.files) {
    report.files.emplace_back(stem + file.ending);
    write_text_file(report.files.back(), file.content);
  }
  return report;
}

std::string identifier(const std::string& text) {
  std::string name;
  for (const char c : text) name += std::isalnum(static_cast<unsigned char>(c)) != 0 ? c : '_';
  if (name.empty() || std::isdigit(static_cast<unsigned char>(name.front())) != 0)
    name = "_" + name;
  return name;
}

std::vector<Vec3> surface_points(const ExportedModel& body) {
  if (!body.surface) return {};
  return interpolate(body.surface_of_nodes, body.model.rest);
}

std::vector<std::string> lost_beside_springs(const MassSpringModel& model) {
  std::vector<std::string> losses;
  if (!model.dilatation.empty())
    losses.push_back(fmt::format(
        "{} dilatation terms: the body has Poisson's ratio 1/4 there, whatever its materials say",
        model.dilatation.count()));
  if (!model.corners.empty())
    losses.push_back("corners of cells: nothing keeps cells from turning inside out");
  if (!model.surface.empty())
    losses.push_back("contact points of cut cells: the body touches at its nodes");
  return losses;
}

}  // namespace springlod::report
