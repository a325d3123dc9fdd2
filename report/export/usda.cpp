#include <iterator>

#include <fmt/format.h>

#include "report/export/draft.hpp"

namespace springlod::report {
namespace {

// A prim below the root. Its attributes are written in the order of the calls.
class Prim {
 public:
  Prim(std::string& text, const char* type, const char* name) : text_(text) {
    add("    def {} \"{}\"\n    {{\n", type, name);
  }

  void set(const char* declaration, const std::string& value) {
    add("        {} = {}\n", declaration, value);
  }
  void set_interpolated(const char* declaration, const std::string& value,
                        const char* interpolation) {
    add("        {} = {} (\n            interpolation = \"{}\"\n        )\n", declaration, value,
        interpolation);
  }
  void end() { text_ += "    }\n"; }

 private:
  template <class... Values>
  void add(fmt::format_string<Values...> format, Values&&... values) {
    fmt::format_to(std::back_inserter(text_), format, std::forward<Values>(values)...);
  }

  std::string& text_;
};

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
  Prim mesh(text, "Mesh", "skin");
  mesh.set("float3[] extent", extent(at, 0));
  mesh.set("int[] faceVertexCounts", list(triangles.size(), [](std::size_t) { return "3"; }));
  mesh.set("int[] faceVertexIndices", list(triangles.size(), [&](std::size_t t) {
             const Triangle& corner = triangles[t];
             return fmt::format("{}, {}, {}", corner[0], corner[1], corner[2]);
           }));
  mesh.set("point3f[] points", points(at));
  mesh.set_interpolated("color3f[] primvars:displayColor", surface_colours(body), "vertex");
  mesh.set("uniform token subdivisionScheme", "\"none\"");
  mesh.end();
}

// Nodes or springs, drawn with this width [m]. With a skin, viewers show them only as guides.
Prim begin_model_prim(std::string& text, const char* type, const char* name,
                      const ExportedModel& body, double width) {
  Prim prim(text, type, name);
  if (body.surface) prim.set("uniform token purpose", "\"guide\"");
  prim.set("float3[] extent", extent(body.model.rest, width / 2));
  return prim;
}

void set_points(Prim& prim, const std::string& points, double width) {
  prim.set("point3f[] points", points);
  prim.set_interpolated("float[] widths", fmt::format("[{}]", width), "constant");
}

void add_nodes(std::string& text, const ExportedModel& body, double width) {
  const MassSpringModel& model = body.model;
  Prim nodes = begin_model_prim(text, "Points", "nodes", body, width);
  set_points(nodes, points(model.rest), width);
  nodes.set("custom double3[] springlod:rest", points(model.rest));
  nodes.set("custom double[] springlod:mass", numbers(model.mass));
  nodes.set("custom double[] springlod:volume", numbers(model.volume));
  nodes.set("custom double[] springlod:contactArea", numbers(model.contact_area));
  nodes.set("custom int[] springlod:material", numbers(model.material));
  nodes.end();
}

void add_springs(std::string& text, const ExportedModel& body, double width) {
  const MassSpringModel& model = body.model;
  const std::size_t count = model.spring_count();
  Prim springs = begin_model_prim(text, "BasisCurves", "springs", body, width);
  springs.set("uniform token type", "\"linear\"");
  springs.set("int[] curveVertexCounts", list(count, [](std::size_t) { return "2"; }));
  set_points(springs,
             list(count,
                  [&](std::size_t s) {
                    return triple(model.rest[model.a[s]]) + ", " + triple(model.rest[model.b[s]]);
                  }),
             width);
  springs.set("custom int[] springlod:a", numbers(model.a));
  springs.set("custom int[] springlod:b", numbers(model.b));
  springs.set("custom double[] springlod:restLength", numbers(model.rest_length));
  springs.set("custom double[] springlod:stiffness", numbers(model.stiffness));
  springs.set("custom double[] springlod:damping", numbers(model.damping));
  springs.end();
}

std::string quoted(const std::string& text) {
  std::string word = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') word += '\\';
    word += c;
  }
  return word + "\"";
}

// Attributes of the root.
void add_materials(std::string& text, const std::vector<Material>& materials) {
  const auto set = [&](const char* declaration, const std::string& value) {
    fmt::format_to(std::back_inserter(text), "    custom {} = {}\n", declaration, value);
  };
  const auto each = [&](double Material::*value) {
    return list(materials.size(),
                [&](std::size_t m) { return fmt::format("{}", materials[m].*value); });
  };
  set("string[] springlod:materialNames",
      list(materials.size(), [&](std::size_t m) { return quoted(materials[m].name); }));
  set("double[] springlod:materialYoung", each(&Material::young));
  set("double[] springlod:materialPoisson", each(&Material::poisson));
  set("double[] springlod:materialDensity", each(&Material::density));
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
