// MuJoCo: a model in MJCF. Each node is a body with three slide joints, each spring a tendon.

#include <cmath>

#include <fmt/format.h>

#include "elastic/stable_step.hpp"
#include "report/export/draft.hpp"

namespace springlod::report {

namespace {

// Below the stable step of the model at rest: springs become stiffer across when they stretch.
constexpr double kStepFraction = 0.8;
// Radius of a node's contact ball, as a fraction of the mean spring length: the gap to an obstacle
// stays small, and a ball does not slip through a floor in a step.
constexpr double kBallFraction = 0.05;
// Inertia of a node [kg m2]. MuJoCo wants one, although a node with slide joints never turns.
constexpr double kAnyInertia = 1e-6;

std::string vector(const Vec3& v) {
  return fmt::format("{:.12g} {:.12g} {:.12g}", v.x(), v.y(), v.z());
}

// MuJoCo wants a step above 0, also for a body without springs.
double timestep(const MassSpringModel& model) {
  constexpr double kDefault = 0.002;
  const double stable = kStepFraction * elastic::stable_step(model);
  if (!std::isfinite(stable) || stable > kDefault) return kDefault;
  // Two digits, rounded down: 0.00041 instead of 0.000412963.
  const double unit = std::pow(10, std::floor(std::log10(stable)) - 1);
  return std::floor(stable / unit) * unit;
}

std::string head(const ExportedModel& body, double step, const std::vector<std::string>& lines) {
  std::string text = fmt::format(
      "<!-- {}, by {}.\n     SI units, z is up. Node i is the body {}_i; "
      "to hold a node, delete its three joints.\n",
      body.name, body.origin, body.name);
  for (const std::string& line : lines) text += fmt::format("     {}\n", line);
  text += "-->\n";
  text += fmt::format(
      "<mujoco model=\"{}\">\n"
      "  <option timestep=\"{:.4g}\" gravity=\"{}\" jacobian=\"sparse\"/>\n",
      body.name, step, vector(body.gravity));
  // The balls touch obstacles, which have contype 1 by default, and never one another.
  text += fmt::format(
      "  <default>\n    <default class=\"{0}\">\n"
      "      <geom type=\"sphere\" size=\"{1:.4g}\" contype=\"0\" conaffinity=\"1\" "
      "group=\"3\"/>\n      <site group=\"4\" size=\"{1:.4g}\"/>\n"
      "      <tendon group=\"4\" width=\"{2:.4g}\"/>\n",
      body.name, kBallFraction * mean_spring_length(body.model) + 1e-6,
      0.2 * kBallFraction * mean_spring_length(body.model) + 1e-6);
  for (const char* axis :
       {"x\"><joint type=\"slide\" axis=\"1 0 0", "y\"><joint type=\"slide\" axis=\"0 1 0",
        "z\"><joint type=\"slide\" axis=\"0 0 1"})
    text += fmt::format("      <default class=\"{}_{}\"/></default>\n", body.name, axis);
  return text + "    </default>\n  </default>\n";
}

// A node a line, so that an editor or a script finds and holds it.
void add_nodes(std::string& text, const ExportedModel& body) {
  const MassSpringModel& model = body.model;
  text += fmt::format("  <worldbody>\n    <body name=\"{0}\" childclass=\"{0}\">\n", body.name);
  for (std::uint32_t n = 0; n < model.node_count(); ++n) {
    fmt::format_to(std::back_inserter(text),
                   "      <body name=\"{0}_{1}\" pos=\"{2}\"><inertial pos=\"0 0 0\" "
                   "mass=\"{3:.12g}\" diaginertia=\"{4} {4} {4}\"/><joint class=\"{0}_x\"/><joint "
                   "class=\"{0}_y\"/><joint class=\"{0}_z\"/><site name=\"{0}_{1}\"/>",
                   body.name, n, vector(model.rest[n]), model.mass[n], kAnyInertia);
    if (model.contact_area[n] > 0) text += "<geom/>";
    text += "</body>\n";
  }
  text += "    </body>\n  </worldbody>\n";
}

void add_springs(std::string& text, const ExportedModel& body) {
  const MassSpringModel& model = body.model;
  if (model.spring_count() == 0) return;
  text += "  <tendon>\n";
  for (std::uint32_t s = 0; s < model.spring_count(); ++s)
    fmt::format_to(
        std::back_inserter(text),
        "    <spatial class=\"{0}\" springlength=\"{1:.12g}\" stiffness=\"{2:.12g}\" "
        "damping=\"{3:.12g}\"><site site=\"{0}_{4}\"/><site site=\"{0}_{5}\"/></spatial>\n",
        body.name, model.rest_length[s], model.stiffness[s], model.damping[s], model.a[s],
        model.b[s]);
  text += "  </tendon>\n";
}

// A skin binds vertices by bones; ours the other way round.
struct Bone {
  std::vector<std::uint32_t> vertex;
  std::vector<double> weight;
};

std::vector<Bone> bones(const Binding& binding, std::uint32_t nodes) {
  std::vector<Bone> list(nodes);
  for (std::uint32_t v = 0; v < binding.point_count(); ++v)
    for (std::uint32_t i = binding.start[v]; i < binding.start[v + 1]; ++i) {
      list[binding.node[i]].vertex.push_back(v);
      list[binding.node[i]].weight.push_back(binding.weight[i]);
    }
  return list;
}

void add_skin(std::string& text, const ExportedModel& body) {
  if (!body.surface) return;
  text += fmt::format("  <deformable>\n    <skin name=\"{}\" rgba=\"0.6 0.65 0.75 1\"\n vertex=\"",
                      body.name);
  for (const Vec3& p : surface_points(body))
    fmt::format_to(std::back_inserter(text), "{:.7g} {:.7g} {:.7g}\n", p.x(), p.y(), p.z());
  text += "\"\n face=\"";
  for (const Triangle& t : body.surface->triangles)
    fmt::format_to(std::back_inserter(text), "{} {} {}\n", t[0], t[1], t[2]);
  text += "\">\n";
  const std::vector<Bone> list = bones(body.surface_of_nodes, body.model.node_count());
  for (std::uint32_t n = 0; n < list.size(); ++n) {
    if (list[n].vertex.empty()) continue;
    fmt::format_to(std::back_inserter(text),
                   "      <bone body=\"{}_{}\" bindpos=\"{}\" bindquat=\"1 0 0 0\" vertid=\"{}\" "
                   "vertweight=\"{:.7g}\"/>\n",
                   body.name, n, vector(body.model.rest[n]), fmt::join(list[n].vertex, " "),
                   fmt::join(list[n].weight, " "));
  }
  text += "    </skin>\n  </deformable>\n";
}

}  // namespace

ExportDraft draft_mujoco(const ExportedModel& body) {
  const double step = timestep(body.model);
  ExportDraft draft;
  draft.settings = {
      fmt::format(
          "timestep {:.4g} s: MuJoCo integrates the springs explicitly, with any integrator; "
          "at rest the body is stable up to {:.4g} s",
          step, elastic::stable_step(body.model)),
      "damping of springs is in the file; no further damping is needed"};
  draft.losses = lost_beside_springs(body.model);
  draft.losses.push_back("contact of the surface: obstacles meet a small ball at each node of it");
  std::vector<std::string> lines = draft.settings;
  for (const std::string& loss : draft.losses) lines.push_back("Not here: " + loss);
  std::string text = head(body, step, lines);
  add_nodes(text, body);
  add_springs(text, body);
  add_skin(text, body);
  text += "</mujoco>\n";
  draft.files = {{".xml", std::move(text)}};
  return draft;
}

}  // namespace springlod::report
