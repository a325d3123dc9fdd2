#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "base/choice.hpp"
#include "model/binding.hpp"
#include "model/mass_spring.hpp"
#include "model/mesh.hpp"
#include "model/vec.hpp"

namespace springlod::report {

struct ExportDraft;

/// A model to write, with what belongs to it. The references must outlive it.
struct ExportedModel {
  const MassSpringModel& model;
  const TriangleMesh* surface = nullptr;  ///< of the body; null if there is none
  Binding surface_of_nodes = {};          ///< of its vertices from the nodes of the model
  std::string name = "body";              ///< of the body, as programs take it: [A-Za-z0-9_]
  std::string origin = {};                ///< one line for comments: where the model comes from
  Vec3 gravity{0, 0, -9.81};              ///< acceleration that the settings reckon with [m/s2]
};

/// Files of other programs that hold a mass-spring model.
enum class ModelFormat { jolt, mujoco, bullet, newton, sofa, msh, vtk, usda, obj, npz, json };

/// A row of the table of formats; in the order in which help lists them.
struct ModelFormatChoice : Choice<ModelFormat> {
  ExportDraft (*write)(const ExportedModel& body);
};
ChoiceTable<ModelFormatChoice> choices(ModelFormat);

/// What was written, and what a user should know of it, each a line of text.
struct ExportReport {
  std::vector<std::filesystem::path> files;  ///< the main one first
  std::vector<std::string> settings;         ///< those that keep the body stable and right
  std::vector<std::string> losses;           ///< what the format does not hold
};

/// Writes a model. `path` names one of its files; without an ending of the format it is a stem, to
/// which the endings are added. Further files have the same stem. Each file is whole or not there.
/// Throws InputError for a model that the format cannot hold, IoError.
ExportReport export_model(const ExportedModel& body, ModelFormat format,
                          const std::filesystem::path& path);

/// A name made of [A-Za-z0-9_], which does not begin with a digit: "my ball-2" -> "my_ball_2".
std::string identifier(const std::string& text);

}  // namespace springlod::report
