#include <array>
#include <iterator>

#include <fmt/format.h>

#include "report/export/draft.hpp"
#include "report/export/tetrahedra.hpp"

namespace springlod::report {
namespace {

constexpr int kLine = 1, kTetrahedron = 4;  // element types of Gmsh

template <class... Values>
void append(std::string& text, fmt::format_string<Values...> format, Values&&... values) {
  fmt::format_to(std::back_inserter(text), format, std::forward<Values>(values)...);
}

// A name between quotes, in one line.
std::string quotable(std::string name) {
  for (char& c : name)
    if (c == '"' || static_cast<unsigned char>(c) < ' ') c = '_';
  return name;
}

// A file of the format MSH 2.2 (ASCII): all entities are counted from 1.
class MshFile {
 public:
  void group(int dimension, const std::string& name) {
    append(groups_, "{} {} \"{}\"\n", dimension, ++group_, quotable(name));
  }

  // An element of a group, which is its elementary entity, too.
  template <class Nodes>
  void element(int type, int group, const Nodes& nodes) {
    append(elements_, "{} {} 2 {} {}", ++element_, type, group, group);
    for (const std::uint32_t node : nodes) append(elements_, " {}", node + 1);
    elements_ += '\n';
  }

  // A value for each node, or for each element: some readers take no other numbers of values.
  void data(const char* of, const char* name, const std::vector<double>& values) {
    append(data_, "${}\n1\n\"{}\"\n1\n0.0\n3\n0\n1\n{}\n", of, name, values.size());
    for (std::size_t i = 0; i < values.size(); ++i) append(data_, "{} {}\n", i + 1, values[i]);
    append(data_, "$End{}\n", of);
  }

  std::string file(const std::string& comments, const std::vector<Vec3>& points) const {
    std::string text = "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n";
    append(text, "$Comments\n{}$EndComments\n", comments);
    append(text, "$PhysicalNames\n{}\n{}$EndPhysicalNames\n", group_, groups_);
    append(text, "$Nodes\n{}\n", points.size());
    for (std::size_t n = 0; n < points.size(); ++n)
      append(text, "{} {} {} {}\n", n + 1, points[n].x(), points[n].y(), points[n].z());
    append(text, "$EndNodes\n$Elements\n{}\n{}$EndElements\n{}", element_, elements_, data_);
    return text;
  }

 private:
  std::string groups_, elements_, data_;
  int group_ = 0;
  std::size_t element_ = 0;
};

std::string comments_of(const ExportedModel& body) {
  std::string text = fmt::format("{}; SI units, z up\n", body.origin);
  for (const Material& m : body.model.materials)
    append(text, "{}: E = {} Pa, nu = {}, density = {} kg/m3, damping time = {} s\n",
           quotable(m.name), m.young, m.poisson, m.density, m.damping);
  return text;
}

std::string springs_file(const ExportedModel& body) {
  const MassSpringModel& model = body.model;
  MshFile file;
  file.group(1, "springs");
  for (std::uint32_t s = 0; s < model.spring_count(); ++s)
    file.element(kLine, 1, std::array{model.a[s], model.b[s]});
  file.data("ElementData", "rest_length", model.rest_length);
  file.data("ElementData", "stiffness", model.stiffness);
  file.data("ElementData", "damping", model.damping);
  file.data("NodeData", "mass", model.mass);
  return file.file(comments_of(body), model.rest);
}

// Group m + 1 is material m, for programs that give each group its material. No elements of another
// dimension: some versions of meshio cannot split values among several types of elements.
std::string tetrahedra_file(const ExportedModel& body, const Tetrahedra& tetrahedra) {
  const MassSpringModel& model = body.model;
  MshFile file;
  for (const Material& material : model.materials) file.group(3, material.name);
  for (std::uint32_t t = 0; t < tetrahedra.count(); ++t)
    file.element(kTetrahedron, static_cast<int>(tetrahedra.material[t]) + 1, tetrahedra.nodes[t]);
  file.data("ElementData", "young", young_of(model, tetrahedra));
  file.data("ElementData", "poisson", poisson_of(model, tetrahedra));
  file.data("ElementData", "density", density_of(model, tetrahedra));
  file.data("NodeData", "mass", model.mass);
  return file.file(comments_of(body), model.rest);
}

}  // namespace

ExportDraft draft_msh(const ExportedModel& body) {
  ExportDraft draft;
  draft.files = {{".msh", springs_file(body)}};
  const Tetrahedra tetrahedra = tetrahedra_of_cells(body.model);
  if (tetrahedra.empty())
    draft.losses = {no_tetrahedra(body.model)};
  else
    draft.files.push_back({"-tetrahedra.msh", tetrahedra_file(body, tetrahedra)});
  draft.losses.emplace_back("contact areas of the nodes");
  if (body.surface) draft.losses.emplace_back("the surface of the body");
  if (!body.model.dilatation.empty()) draft.losses.emplace_back("dilatation terms of the springs");
  return draft;
}

}  // namespace springlod::report
