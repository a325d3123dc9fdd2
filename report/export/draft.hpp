#pragma once

#include <string>
#include <vector>

#include "report/export/export.hpp"

namespace springlod::report {

/// A file of an export before it is written.
struct ExportFile {
  std::string ending;  ///< what follows the common stem: ".xml", ".reader.py"
  std::string content;
};

/// What the writer of a format makes.
struct ExportDraft {
  std::vector<ExportFile> files;  ///< the main one first
  std::vector<std::string> settings;
  std::vector<std::string> losses;
};

// One function for each file of this folder that is named after a format.
ExportDraft draft_obj(const ExportedModel& body);
ExportDraft draft_json(const ExportedModel& body);
ExportDraft draft_msh(const ExportedModel& body);
ExportDraft draft_newton(const ExportedModel& body);
ExportDraft draft_npz(const ExportedModel& body);
ExportDraft draft_sofa(const ExportedModel& body);
ExportDraft draft_usda(const ExportedModel& body);
ExportDraft draft_vtk(const ExportedModel& body);
ExportDraft draft_jolt(const ExportedModel& body);
ExportDraft draft_mujoco(const ExportedModel& body);
ExportDraft draft_bullet(const ExportedModel& body);

/// Positions of the surface's vertices at rest, as the model's nodes give them [m]; empty without a
/// surface.
std::vector<Vec3> surface_points(const ExportedModel& body);

/// Lines for what programs that know only nodes and springs lose of this model: its dilatation
/// terms, corners, contact points, a volume of nodes.
std::vector<std::string> lost_beside_springs(const MassSpringModel& model);

}  // namespace springlod::report
