#include <iterator>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "report/export/draft.hpp"
#include "report/export/explicit_step.hpp"
#include "report/export/tetrahedra.hpp"

namespace springlod::report {
namespace {

constexpr double kImplicitStep = 1e-3;  // [s]; as our own implicit integrators

template <class... Values>
void append(std::string& text, fmt::format_string<Values...> format, Values&&... values) {
  fmt::format_to(std::back_inserter(text), format, std::forward<Values>(values)...);
}

std::string points_of(const std::vector<Vec3>& points) {
  std::string text;
  for (const Vec3& p : points) append(text, "{} {} {} ", p.x(), p.y(), p.z());
  return text;
}

template <class Rows>
std::string rows_of(const Rows& rows) {
  std::string text;
  for (const auto& row : rows) append(text, "{} ", fmt::join(row, " "));
  return text;
}

// The start of a scene, up to the solver.
std::string scene_start(const ExportedModel& body, double step, const std::string& solver) {
  std::string text =
      fmt::format("<?xml version=\"1.0\"?>\n<!-- {}; SI units, z up -->\n", body.origin);
  append(text, "<Node name=\"root\" dt=\"{:.6g}\" gravity=\"{} {} {}\">\n", step, body.gravity.x(),
         body.gravity.y(), body.gravity.z());
  for (const char* plugin :
       {"Sofa.Component.LinearSolver.Iterative", "Sofa.Component.Mapping.Linear",
        "Sofa.Component.Mass", "Sofa.Component.ODESolver.Backward",
        "Sofa.Component.ODESolver.Forward", "Sofa.Component.SolidMechanics.FEM.Elastic",
        "Sofa.Component.SolidMechanics.Spring", "Sofa.Component.StateContainer",
        "Sofa.Component.Topology.Container.Constant", "Sofa.Component.Visual",
        "Sofa.GL.Component.Rendering3D"})
    append(text, "  <RequiredPlugin name=\"{}\"/>\n", plugin);
  append(text,
         "  <DefaultAnimationLoop/>\n"
         "  <VisualStyle displayFlags=\"showVisualModels showForceFields\"/>\n"
         "  <Node name=\"{}\">\n{}",
         body.name, solver);
  return text;
}

std::string topology_of(const MassSpringModel& model, const Tetrahedra& tetrahedra) {
  std::string edges;
  for (std::uint32_t s = 0; s < model.spring_count(); ++s)
    append(edges, "{} {} ", model.a[s], model.b[s]);
  return fmt::format("    <MeshTopology name=\"topology\" edges=\"{}\" tetrahedra=\"{}\"/>\n",
                     edges, rows_of(tetrahedra.nodes));
}

std::string nodes_of(const MassSpringModel& model) {
  return fmt::format(
      "    <MechanicalObject name=\"nodes\" template=\"Vec3d\" position=\"{}\"/>\n"
      "    <DiagonalMass name=\"mass\" vertexMass=\"{}\"/>\n",
      points_of(model.rest), fmt::join(model.mass, " "));
}

// The surface, mapped by the tetrahedra that its vertices are in.
std::string skin_of(const ExportedModel& body) {
  if (!body.surface) return "";
  return fmt::format(
      "    <Node name=\"skin\">\n"
      "      <OglModel name=\"skin\" position=\"{}\" triangles=\"{}\"/>\n"
      "      <BarycentricMapping/>\n"
      "    </Node>\n",
      points_of(surface_points(body)), rows_of(body.surface->triangles));
}

constexpr const char* kSceneEnd = "  </Node>\n</Node>\n";

std::string springs_scene(const ExportedModel& body, const Tetrahedra& tetrahedra, double step) {
  const MassSpringModel& model = body.model;
  std::string text = scene_start(body, step, "    <EulerExplicitSolver symplectic=\"true\"/>\n");
  text += topology_of(model, tetrahedra) + nodes_of(model);
  // Of old and new versions alike; with an implicit solver, those before 24.06 need
  // StiffSpringForceField in its place.
  text += "    <SpringForceField name=\"springs\" template=\"Vec3d\" spring=\"";
  for (std::uint32_t s = 0; s < model.spring_count(); ++s)
    append(text, "{} {} {} {} {}  ", model.a[s], model.b[s], model.stiffness[s], model.damping[s],
           model.rest_length[s]);
  text += "\"/>\n";
  if (!tetrahedra.empty()) text += skin_of(body);
  return text + kSceneEnd;
}

// A node with the tetrahedra of each material, over the same degrees of freedom: a force field has
// one Poisson's ratio and one damping time.
std::string tetrahedra_scene(const ExportedModel& body, const Tetrahedra& all) {
  const MassSpringModel& model = body.model;
  std::string text = scene_start(
      body, kImplicitStep,
      "    <EulerImplicitSolver rayleighMass=\"0\" rayleighStiffness=\"0\"/>\n"
      "    <CGLinearSolver iterations=\"200\" tolerance=\"1e-9\" threshold=\"1e-9\"/>\n");
  text += topology_of(model, all) + nodes_of(model);
  const std::vector<double> young = young_of(model, all);
  for (std::uint32_t m = 0; m < model.materials.size(); ++m) {
    const Material& material = model.materials[m];
    std::string nodes, moduli;
    for (std::uint32_t t = 0; t < all.count(); ++t) {
      if (all.material[t] != m) continue;
      append(nodes, "{} ", fmt::join(all.nodes[t], " "));
      append(moduli, "{} ", young[t]);
    }
    if (nodes.empty()) continue;
    append(text,
           "    <Node name=\"{}_{}\">\n"
           "      <MeshTopology name=\"topology\" tetrahedra=\"{}\"/>\n"
           "      <TetrahedronFEMForceField template=\"Vec3d\" method=\"large\" "
           "youngModulus=\"{}\" poissonRatio=\"{}\" rayleighStiffness=\"{}\"/>\n"
           "    </Node>\n",
           identifier(material.name), m, nodes, moduli, material.poisson, material.damping);
  }
  return text + skin_of(body) + kSceneEnd;
}

}  // namespace

ExportDraft draft_sofa(const ExportedModel& body) {
  const MassSpringModel& model = body.model;
  const double step = explicit_step(model);
  const Tetrahedra tetrahedra = tetrahedra_of_cells(model);
  ExportDraft draft;
  draft.files = {{".scn", springs_scene(body, tetrahedra, step)}};
  draft.settings = {explicit_step_line(model, step) + "; the scene has this step as its dt"};
  draft.losses = lost_beside_springs(model);
  if (tetrahedra.empty()) {
    draft.losses.push_back(no_tetrahedra(model));
    draft.losses.emplace_back("the surface: the scene draws the springs");
  } else {
    draft.files.push_back({"-tetrahedra.scn", tetrahedra_scene(body, tetrahedra)});
    draft.settings.push_back(fmt::format(
        "tetrahedra: implicit Euler with dt = {:g} s, stable at any step; it adds a damping ratio "
        "of pi f dt to a mode of frequency f (3 % at 10 Hz)",
        kImplicitStep));
  }
  return draft;
}

}  // namespace springlod::report
