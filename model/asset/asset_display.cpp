#include "model/asset/asset_display.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <string>

#include <fmt/format.h>

#include "model/creases.hpp"

namespace springlod::inline model {
namespace {

using Float3 = std::array<float, 3>;
using Byte4 = std::array<std::uint8_t, 4>;

/// Levels stand this many times their width apart.
constexpr double kGap = 1.25;

/// The sRGB transfer function: colours here are display values, glTF wants linear ones.
double linear(float srgb) {
  return srgb <= 0.04045F ? srgb / 12.92 : std::pow((srgb + 0.055) / 1.055, 2.4);
}

std::vector<Float3> single_precision(const std::vector<Vec3>& points) {
  std::vector<Float3> floats;
  floats.reserve(points.size());
  for (const Vec3& p : points) {
    const Eigen::Vector3f f = p.cast<float>();
    floats.push_back({f.x(), f.y(), f.z()});
  }
  return floats;
}

/// glTF wants unit length even where all triangles are degenerate: up there.
std::vector<Float3> normals_for_gltf(const SplitSurface& surface,
                                     const std::vector<Vec3>& positions) {
  std::vector<Float3> normals;
  normals.reserve(surface.source.size());
  for (const Eigen::Vector3f& n : vertex_normals(surface, positions))
    normals.push_back(n.isZero(0) ? Float3{0, 0, 1} : Float3{n.x(), n.y(), n.z()});
  return normals;
}

class Display {
 public:
  Display(tinygltf::Model& gltf, AssetBuffer& buffer) : gltf_(gltf), buffer_(buffer) {}

  void add(const LodAsset& asset, const std::vector<int>& spring_ends) {
    tinygltf::Node root;
    root.name = "z up";
    // A quarter turn about x, (x, y, z) -> (x, z, -y), as quaternion x, y, z, w.
    root.rotation = {-std::sqrt(0.5), 0, 0, std::sqrt(0.5)};
    gltf_.nodes.push_back(root);

    const Box3 box = bounds(asset.surface).merged(bounds(asset.chain.levels[0].model.rest));
    // A model flat along x still needs room between its levels.
    const double step = kGap * std::max(box.sizes().x(), 0.1 * box.sizes().norm());
    double shift = 0;
    if (!asset.surface.triangles.empty()) {
      add_node("surface", surface_mesh(asset), shift);
      shift += step;
    }
    for (std::size_t n = 0; n < asset.chain.levels.size(); ++n, shift += step) {
      const MassSpringModel& model = asset.chain.levels[n].model;
      add_node(fmt::format("level {} ({} nodes)", n, model.node_count()),
               level_mesh(model, spring_ends[n]), shift);
    }
    gltf_.scenes.emplace_back();
    gltf_.scenes[0].nodes = {0};
    gltf_.defaultScene = 0;
  }

 private:
  void add_node(const std::string& name, tinygltf::Mesh mesh, double shift) {
    mesh.name = name;
    gltf_.meshes.push_back(std::move(mesh));
    tinygltf::Node node;
    node.name = name;
    node.mesh = static_cast<int>(gltf_.meshes.size()) - 1;
    if (shift != 0) node.translation = {shift, 0, 0};
    gltf_.nodes.push_back(std::move(node));
    gltf_.nodes[0].children.push_back(static_cast<int>(gltf_.nodes.size()) - 1);
  }

  int add_accessor(int view, int component, int type, std::size_t count, std::size_t offset = 0) {
    tinygltf::Accessor accessor;
    accessor.bufferView = view;
    accessor.byteOffset = offset;
    accessor.componentType = component;
    accessor.type = type;
    accessor.count = count;
    gltf_.accessors.push_back(std::move(accessor));
    return static_cast<int>(gltf_.accessors.size()) - 1;
  }

  int add_positions(const std::vector<Vec3>& points) {
    const std::vector<Float3> floats = single_precision(points);
    const int accessor = add_vectors(floats);
    Float3 low = floats[0];
    Float3 high = floats[0];
    for (const Float3& p : floats)
      for (std::size_t d = 0; d < 3; ++d) {
        low[d] = std::min(low[d], p[d]);
        high[d] = std::max(high[d], p[d]);
      }
    gltf_.accessors.back().minValues.assign(low.begin(), low.end());
    gltf_.accessors.back().maxValues.assign(high.begin(), high.end());
    return accessor;
  }

  int add_vectors(const std::vector<Float3>& vectors) {
    return add_accessor(buffer_.add(vectors, TINYGLTF_TARGET_ARRAY_BUFFER),
                        TINYGLTF_COMPONENT_TYPE_FLOAT, TINYGLTF_TYPE_VEC3, vectors.size());
  }

  template <class T>
  int add_numbers(const std::vector<T>& values) {
    std::vector<float> floats;
    floats.reserve(values.size());
    for (const T value : values) floats.push_back(static_cast<float>(value));
    return add_accessor(buffer_.add(floats, TINYGLTF_TARGET_ARRAY_BUFFER),
                        TINYGLTF_COMPONENT_TYPE_FLOAT, TINYGLTF_TYPE_SCALAR, floats.size());
  }

  int add_colours(const MassSpringModel& model) {
    std::vector<Byte4> of_material;
    for (const Material& material : model.materials) {
      const auto byte = [](float c) {
        return static_cast<std::uint8_t>(std::lround(255 * std::clamp(linear(c), 0.0, 1.0)));
      };
      of_material.push_back(
          {byte(material.colour.r), byte(material.colour.g), byte(material.colour.b), 255});
    }
    std::vector<Byte4> colours;
    colours.reserve(model.material.size());
    for (const std::uint32_t material : model.material) colours.push_back(of_material[material]);
    const int accessor =
        add_accessor(buffer_.add(colours, TINYGLTF_TARGET_ARRAY_BUFFER),
                     TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE, TINYGLTF_TYPE_VEC4, colours.size());
    gltf_.accessors.back().normalized = true;
    return accessor;
  }

  tinygltf::Mesh level_mesh(const MassSpringModel& model, int spring_ends) {
    tinygltf::Primitive points;
    points.mode = TINYGLTF_MODE_POINTS;
    points.attributes = {
        {"POSITION", add_positions(model.rest)}, {"COLOR_0", add_colours(model)},
        {"_MASS", add_numbers(model.mass)},      {"_VOLUME", add_numbers(model.volume)},
        {"_BORDER", add_numbers(model.border)},  {"_MATERIAL", add_numbers(model.material)}};
    tinygltf::Mesh mesh;
    mesh.primitives.push_back(points);
    if (spring_ends < 0) return mesh;
    tinygltf::Primitive lines;
    lines.mode = TINYGLTF_MODE_LINE;
    lines.attributes = {{"POSITION", points.attributes["POSITION"]},
                        {"COLOR_0", points.attributes["COLOR_0"]}};
    lines.indices = add_accessor(spring_ends, TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT,
                                 TINYGLTF_TYPE_SCALAR, model.end_count());
    mesh.primitives.push_back(lines);
    return mesh;
  }

  tinygltf::Mesh surface_mesh(const LodAsset& asset) {
    const TriangleMesh& surface = asset.surface;
    const SplitSurface shaded = split_at_creases(surface);
    std::vector<Vec3> points;
    points.reserve(shaded.source.size());
    for (const std::uint32_t v : shaded.source) points.push_back(surface.positions[v]);
    const int positions = add_positions(points);
    const int normals = add_vectors(normals_for_gltf(shaded, surface.positions));
    const int triangles = buffer_.add(shaded.triangles, TINYGLTF_TARGET_ELEMENT_ARRAY_BUFFER);
    tinygltf::Mesh mesh;
    for (std::size_t p = 0; p < surface.parts.size(); ++p) {
      const MeshPart& part = surface.parts[p];
      if (part.triangle_count == 0) continue;
      tinygltf::Primitive primitive;
      primitive.mode = TINYGLTF_MODE_TRIANGLES;
      primitive.attributes = {{"POSITION", positions}, {"NORMAL", normals}};
      primitive.indices = add_accessor(triangles, TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT,
                                       TINYGLTF_TYPE_SCALAR, std::size_t{3} * part.triangle_count,
                                       sizeof(Triangle) * part.first_triangle);
      primitive.material = part_material(part, asset.chain.levels[0].model.materials, p);
      mesh.primitives.push_back(std::move(primitive));
    }
    return mesh;
  }

  /// The glTF material of a part: coloured as the springs' material of its name is.
  int part_material(const MeshPart& part, const std::vector<Material>& materials, std::size_t p) {
    const std::string& name = part.material.empty() ? part.name : part.material;
    const auto [known, is_new] =
        material_of_name_.emplace(name, static_cast<int>(gltf_.materials.size()));
    if (!is_new) return known->second;
    Colour colour = palette_colour(p);
    for (const Material& m : materials)
      if (m.name == part.name || m.name == part.material) colour = m.colour;
    tinygltf::Material material;
    material.name = name;
    material.doubleSided = true;
    material.pbrMetallicRoughness.baseColorFactor = {linear(colour.r), linear(colour.g),
                                                     linear(colour.b), 1};
    material.pbrMetallicRoughness.metallicFactor = 0;
    material.pbrMetallicRoughness.roughnessFactor = 0.8;  // dull, as rubber or wood
    gltf_.materials.push_back(std::move(material));
    return known->second;
  }

  tinygltf::Model& gltf_;
  AssetBuffer& buffer_;
  std::map<std::string, int> material_of_name_;
};

}  // namespace

void add_display(const LodAsset& asset, const std::vector<int>& spring_ends, tinygltf::Model& gltf,
                 AssetBuffer& buffer) {
  Display(gltf, buffer).add(asset, spring_ends);
}

}  // namespace springlod::inline model
