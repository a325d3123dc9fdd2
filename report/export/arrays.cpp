#include "report/export/arrays.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

namespace springlod::report {

namespace {

constexpr std::size_t kColumns = 100;

constexpr const char* kSkinVertex =
    R"(/// Place of a vertex of the skin; `node_at(i)` gives the place of a node, with p[0] to p[2].
template <class NodeAt>
std::array<float, 3> skin_vertex(std::uint32_t vertex, const NodeAt& node_at) {
  std::array<float, 3> place{};
  for (std::uint32_t i = kSkinStart[vertex]; i < kSkinStart[vertex + 1]; ++i) {
    const auto p = node_at(kSkinNode[i]);
    for (int axis = 0; axis < 3; ++axis) place[axis] += kSkinWeight[i] * static_cast<float>(p[axis]);
  }
  return place;
}
)";

template <class T, class Word>
std::string wrapped(std::span<const T> values, const Word& word) {
  std::string text, line;
  for (const T value : values) {
    const std::string next = word(value) + ",";
    if (line.size() + next.size() > kColumns) {
      text += line + "\n";
      line.clear();
    }
    line += next;
  }
  return text + line;
}

template <class T>
std::string cpp_array(const char* type, const char* name, const char* about, std::size_t size,
                      const T& numbers) {
  return fmt::format("/// {}\ninline constexpr {} {}[{}] = {{\n{}}};\n", about, type, name, size,
                     numbers);
}

void add_skin(SingleBody& single, const ExportedModel& body) {
  if (!body.surface) return;
  const Binding& binding = body.surface_of_nodes;
  single.skin_start = binding.start;
  single.skin_node = binding.node;
  single.skin_weight.assign(binding.weight.begin(), binding.weight.end());
  for (const Triangle& t : body.surface->triangles)
    single.triangles.insert(single.triangles.end(), t.begin(), t.end());
}

}  // namespace

std::array<float, 3> y_up(const Vec3& vector) {
  // Adding 0 turns -0 into 0.
  return {static_cast<float>(vector.x()), static_cast<float>(vector.z()),
          static_cast<float>(0 - vector.y())};
}

SingleBody single_body(const ExportedModel& body) {
  const MassSpringModel& model = body.model;
  SingleBody single;
  const Vec3 center = bounds(model.rest).center();
  single.center = y_up(center);
  for (const Vec3& node : model.rest)
    for (const float coordinate : y_up(node - center)) {
      single.position.push_back(coordinate);
      single.extent = std::max(single.extent, std::abs(coordinate));
    }
  single.mass.assign(model.mass.begin(), model.mass.end());
  for (std::uint32_t s = 0; s < model.spring_count(); ++s) {
    single.ends.push_back(model.a[s]);
    single.ends.push_back(model.b[s]);
  }
  single.rest_length.assign(model.rest_length.begin(), model.rest_length.end());
  single.stiffness.assign(model.stiffness.begin(), model.stiffness.end());
  add_skin(single, body);
  return single;
}

std::string list(std::span<const float> values, bool cpp) {
  return wrapped(values, [cpp](float value) {
    std::string word = fmt::format("{}", value);
    if (cpp && word.find_first_of(".e") != std::string::npos) word += 'F';
    return word;
  });
}

std::string list(std::span<const std::uint32_t> values) {
  return wrapped(values, [](std::uint32_t value) { return std::to_string(value); });
}

std::string cpp_arrays(const SingleBody& body) {
  const auto floats = [](const char* name, const char* about, const std::vector<float>& values) {
    return cpp_array("float", name, about, values.size(), list(values, true));
  };
  const auto numbers = [](const char* name, const char* about,
                          const std::vector<std::uint32_t>& values) {
    return cpp_array("std::uint32_t", name, about, values.size(), list(values));
  };
  std::string text = fmt::format(
      "inline constexpr std::uint32_t kNodes = {};\ninline constexpr std::uint32_t kSprings = "
      "{};\n",
      body.mass.size(), body.rest_length.size());
  text += fmt::format(
      "/// Middle of the body at rest [m], to which kPosition is relative.\n"
      "inline constexpr float kCenter[3] = {{{}}};\n",
      list(body.center, true));
  text += floats("kPosition", "Nodes at rest, three numbers each [m].", body.position);
  text += floats("kMass", "Of the nodes [kg].", body.mass);
  // An array must not be empty in C++.
  if (body.rest_length.empty()) return text;
  text += numbers("kEnds", "The two nodes of each spring.", body.ends);
  text += floats("kRestLength", "Of the springs [m].", body.rest_length);
  text += floats("kStiffness", "Of the springs [N/m].", body.stiffness);
  if (!body.has_skin()) return text;
  text += fmt::format("inline constexpr std::uint32_t kVertices = {};  // of the skin\n",
                      body.skin_start.size() - 1);
  text += numbers("kSkinStart",
                  "Vertex v is the sum of kSkinWeight[i] times node kSkinNode[i] over "
                  "kSkinStart[v] <= i < kSkinStart[v + 1].",
                  body.skin_start);
  text += numbers("kSkinNode", "See kSkinStart.", body.skin_node);
  text += floats("kSkinWeight", "See kSkinStart.", body.skin_weight);
  text += numbers("kTriangles", "Of the skin, three vertices each, counter-clockwise from outside.",
                  body.triangles);
  return text + kSkinVertex;
}

}  // namespace springlod::report
