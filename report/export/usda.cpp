#include <iterator>

#include <fmt/format.h>

#include "report/export/draft.hpp"

namespace springlod::report {
namespace {

template <class... Values>
void append(std::string& text, fmt::format_string<Values...> format, Values&&... values) {
  fmt::format_to(std::back_inserter(text), format, std::forward<Values>(values)...);
}

// A list in brackets; each(i) gives the text of an element.
template <class Each>
std::string list(std::size_t count, Each each) {
  std::string text = "[";
  for (std::size_t i = 0; i < count; ++i) {
    if (i > 0) text += ", ";
    text += each(i);
  }
  return text + "]";
}

template <class T>
std::string numbers(const std::vector<T>& values) {
  return list(values.size(), [&](std::size_t i) { return fmt::format("{}", values[i]); });
}

std::string triple(const Vec3& p) {
  return fmt::format("({}, {}, {})", p.x(), p.y(), p.z());
}

std::string points(const std::vector<Vec3>& of) {
  return list(of.size(), [&](std::size_t i) { return triple(of[i]); });
}

std::string extent(const std::vector<Vec3>& of, double margin) {
  Box3 box;
  for (const Vec3& p : of) box.extend(p);
  return fmt::format("[{}, {}]", triple(box.min() - Vec3::Constant(margin)),
                     triple(box.max() + Vec3::Constant(margin)));
}

std::string colour(const Colour& c) {
  return fmt::format("({}, {}, {})", c.r, c.g, c.b);
}

// Colour of the material of the node that moves a point of the surface most.
std::string surface_colours(const ExportedModel& body) {
  const MassSpringModel& model = body.model;
  return list(body.surface->positions.size(), [&](std::size_t p) {
    const auto node = main_node(body.surface_of_nodes, static_cast<std::uint32_t>(p));
    return colour(model.materials[model.material[node]].colour);
  });
}

void add_surface(std::string& text, const ExportedModel& body) {
  const std::vector<Vec3> at = surface_points(body);
  const auto& triangles = body.surface->triangles;
  append(text, "    def Mesh \"skin\"\n    {{\n");
  append(text, "        float3[] extent = {}\n", extent(at, 0));
  append(text, "        int[] faceVertexCounts = {}\n",
         list(triangles.size(), [](std::size_t) { return "3"; }));
  append(text, "        int[] faceVertexIndices = {}\n", list(triangles.size(), [&](std::size_t t) {
           const Triangle& corner = triangles[t];
           return fmt::format("{}, {}, {}", corner[0], corner[1], corner[2]);
         }));
  append(text, "        point3f[] points = {}\n", points(at));
  append(text,
         "        color3f[] primvars:displayColor = {} (\n"
         "            interpolation = \"vertex\"\n        )\n",
         surface_colours(body));
  append(text, "        uniform token subdivisionScheme = \"none\"\n    }}\n");
}

// With a skin, viewers show nodes and springs only as guides.
void add_purpose(std::string& text, const ExportedModel& body) {
  if (body.surface) text += "        uniform token purpose = \"guide\"\n";
}

void add_nodes(std::string& text, const ExportedModel& body, double width) {
  const MassSpringModel& model = body.model;
  append(text, "    def Points \"nodes\"\n    {{\n");
  add_purpose(text, body);
  append(text, "        float3[] extent = {}\n", extent(model.rest, width / 2));
  append(text, "        point3f[] points = {}\n", points(model.rest));
  append(text,
         "        float[] widths = [{}] (\n            interpolation = \"constant\"\n        )\n",
         width);
  append(text, "        custom double3[] springlod:rest = {}\n", points(model.rest));
  append(text, "        custom double[] springlod:mass = {}\n", numbers(model.mass));
  append(text, "        custom double[] springlod:volume = {}\n", numbers(model.volume));
  append(text, "        custom double[] springlod:contactArea = {}\n", numbers(model.contact_area));
  append(text, "        custom int[] springlod:material = {}\n    }}\n", numbers(model.material));
}

void add_springs(std::string& text, const ExportedModel& body, double width) {
  const MassSpringModel& model = body.model;
  const std::size_t count = model.spring_count();
  append(text, "    def BasisCurves \"springs\"\n    {{\n");
  add_purpose(text, body);
  append(text, "        float3[] extent = {}\n", extent(model.rest, width / 2));
  append(text, "        uniform token type = \"linear\"\n");
  append(text, "        int[] curveVertexCounts = {}\n",
         list(count, [](std::size_t) { return "2"; }));
  append(text, "        point3f[] points = {}\n", list(count, [&](std::size_t s) {
           return triple(model.rest[model.a[s]]) + ", " + triple(model.rest[model.b[s]]);
         }));
  append(text,
         "        float[] widths = [{}] (\n            interpolation = \"constant\"\n        )\n",
         width);
  append(text, "        custom int[] springlod:a = {}\n", numbers(model.a));
  append(text, "        custom int[] springlod:b = {}\n", numbers(model.b));
  append(text, "        custom double[] springlod:restLength = {}\n", numbers(model.rest_length));
  append(text, "        custom double[] springlod:stiffness = {}\n", numbers(model.stiffness));
  append(text, "        custom double[] springlod:damping = {}\n    }}\n", numbers(model.damping));
}

std::string quoted(const std::string& text) {
  std::string word = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') word += '\\';
    word += c;
  }
  return word + "\"";
}

void add_materials(std::string& text, const std::vector<Material>& materials) {
  const auto each = [&](double Material::*value) {
    return list(materials.size(),
                [&](std::size_t m) { return fmt::format("{}", materials[m].*value); });
  };
  append(text, "    custom string[] springlod:materialNames = {}\n",
         list(materials.size(), [&](std::size_t m) { return quoted(materials[m].name); }));
  append(text, "    custom double[] springlod:materialYoung = {}\n", each(&Material::young));
  append(text, "    custom double[] springlod:materialPoisson = {}\n", each(&Material::poisson));
  append(text, "    custom double[] springlod:materialDensity = {}\n", each(&Material::density));
}

}  // namespace

ExportDraft draft_usda(const ExportedModel& body) {
  const MassSpringModel& model = body.model;
  constexpr double kNodeWidth = 0.2, kSpringWidth = 0.04;  // in spring lengths
  const double length = mean_spring_length(model);
  std::string text = fmt::format(
      "#usda 1.0\n(\n    defaultPrim = \"{}\"\n    doc = {}\n    metersPerUnit = 1\n"
      "    upAxis = \"Z\"\n)\n\ndef Xform \"{}\" (\n    kind = \"component\"\n)\n{{\n",
      body.name, quoted(body.origin), body.name);
  add_materials(text, model.materials);
  if (body.surface) add_surface(text, body);
  add_nodes(text, body, kNodeWidth * length);
  add_springs(text, body, kSpringWidth * length);
  text += "}\n";
  ExportDraft draft{.files = {{".usda", std::move(text)}}, .settings = {}, .losses = {}};
  draft.losses = {
      "dynamics: USD has no springs; masses, stiffness and damping are attributes springlod:*, "
      "which viewers ignore"};
  if (!model.dilatation.empty()) draft.losses.emplace_back("dilatation terms");
  if (!model.corners.empty()) draft.losses.emplace_back("corners of cells");
  if (!model.surface.empty()) draft.losses.emplace_back("contact points of cut cells");
  return draft;
}

}  // namespace springlod::report
