#include "model/asset/asset_display.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <string>
#include <utility>

#include <fmt/format.h>

#include "model/asset/gltf_values.hpp"
#include "model/creases.hpp"
#include "model/drawn_colour.hpp"

namespace springlod::inline model {
namespace {

using nlohmann::json;
using SpringEnds = std::vector<std::optional<std::size_t>>;
using Float3 = std::array<float, 3>;
using Byte4 = std::array<std::uint8_t, 4>;

/// Distance between levels along x, in widths of the base.
constexpr double kGap = 1.25;
// Least width that counts for it, as a fraction of the size [1].
constexpr double kLeastWidth = 0.1;

/// glTF needs normals of unit length also where all triangles are degenerate; +z is used there.
std::vector<Float3> normals_for_gltf(const SplitSurface& surface,
                                     const std::vector<Vec3>& positions) {
  std::vector<Float3> normals;
  normals.reserve(surface.source.size());
  for (const Eigen::Vector3f& n : vertex_normals(surface, positions))
    normals.push_back(n.isZero(0) ? Float3{0, 0, 1} : Float3{n.x(), n.y(), n.z()});
  return normals;
}

/// The component type of an array of integers in a slim asset.
gltf::Component component_of(const json& array) {
  const json& type = array.at("type");
  return type == "uint8"    ? gltf::Component::unsigned_byte
         : type == "uint16" ? gltf::Component::unsigned_short
                            : gltf::Component::unsigned_int;
}

std::size_t bytes_of(gltf::Component component) {
  return component == gltf::Component::unsigned_byte    ? 1
         : component == gltf::Component::unsigned_short ? 2
                                                        : 4;
}

/// The parts of the scene that every asset has.
class Scene {
 public:
  explicit Scene(json& document) : document_(document) {
    // A quarter turn about x, (x, y, z) -> (x, z, -y), as quaternion x, y, z, w.
    append("nodes", {{"name", "z up"}, {"rotation", {-std::sqrt(0.5), 0.0, 0.0, std::sqrt(0.5)}}});
    document_["scenes"] = {{{"nodes", {0}}}};
    document_["scene"] = 0;
  }

 protected:
  /// Adds an entry to a list of the document and returns its number.
  std::size_t append(const char* list, json entry) {
    document_[list].push_back(std::move(entry));
    return document_[list].size() - 1;
  }

  void add_node(const std::string& name, json primitives, double shift) {
    json node{{"name", name},
              {"mesh", append("meshes", {{"name", name}, {"primitives", std::move(primitives)}})}};
    if (shift != 0) node["translation"] = {shift, 0.0, 0.0};
    const std::size_t number = append("nodes", std::move(node));
    document_["nodes"][0]["children"].push_back(number);
  }

  std::size_t add_accessor(std::size_t view, gltf::Component component, const char* type,
                           std::size_t count) {
    return append(
        "accessors",
        {{"bufferView", view}, {"componentType", component}, {"type", type}, {"count", count}});
  }

  void set_bounds(std::size_t accessor, const std::vector<Float3>& points) {
    Float3 low = points[0];
    Float3 high = points[0];
    for (const Float3& p : points)
      for (std::size_t d = 0; d < 3; ++d) {
        low[d] = std::min(low[d], p[d]);
        high[d] = std::max(high[d], p[d]);
      }
    document_["accessors"][accessor]["min"] = low;
    document_["accessors"][accessor]["max"] = high;
  }

  /// One primitive for each mesh part.
  json part_primitives(const LodAsset& asset, const json& attributes, std::size_t triangles,
                       gltf::Component of_indices) {
    json primitives = json::array();
    for (std::size_t p = 0; p < asset.surface.parts.size(); ++p) {
      const MeshPart& part = asset.surface.parts[p];
      if (part.triangle_count == 0) continue;
      const std::size_t indices =
          add_accessor(triangles, of_indices, "SCALAR", std::size_t{3} * part.triangle_count);
      if (part.first_triangle > 0)
        document_["accessors"][indices]["byteOffset"] =
            3 * bytes_of(of_indices) * part.first_triangle;
      primitives.push_back(
          {{"mode", gltf::Mode::triangles},
           {"attributes", attributes},
           {"indices", indices},
           {"material", part_material(part, asset.chain.levels[0].model.materials, p)}});
    }
    return primitives;
  }

  /// The glTF material of a mesh part. It has the colour of the springs' material of the same name.
  std::size_t part_material(const MeshPart& part, const std::vector<Material>& materials,
                            std::size_t p) {
    const std::string& name = part.material.empty() ? part.name : part.material;
    const auto known = material_of_name_.find(name);
    if (known != material_of_name_.end()) return known->second;
    return material_of_name_[name] =
               append("materials", gltf_material(name, part_colour(part, p, materials)));
  }

  json& document_;

 private:
  std::map<std::string, std::size_t> material_of_name_;
};

class Display : private Scene {
 public:
  Display(json& document, AssetBuffer& buffer) : Scene(document), buffer_(buffer) {}

  void add(const LodAsset& asset, const SpringEnds& spring_ends) {
    const Box3 box = bounds(asset.surface).merged(bounds(asset.chain.levels[0].model.rest));
    // A model without width in x also needs space between its levels.
    const double step = kGap * std::max(box.sizes().x(), kLeastWidth * box.sizes().norm());
    double shift = 0;
    if (!asset.surface.triangles.empty()) {
      add_node("surface", surface_primitives(asset), shift);
      shift += step;
    }
    for (std::size_t n = 0; n < asset.chain.levels.size(); ++n, shift += step) {
      const MassSpringModel& model = asset.chain.levels[n].model;
      add_node(fmt::format("level {} ({} nodes)", n, model.node_count()),
               level_primitives(model, spring_ends[n]), shift);
    }
  }

 private:
  std::size_t add_positions(const std::vector<Vec3>& points) {
    const std::vector<Float3> floats = single_precision(points);
    const std::size_t accessor = add_vectors(floats);
    set_bounds(accessor, floats);
    return accessor;
  }

  std::size_t add_vectors(const std::vector<Float3>& vectors) {
    return add_accessor(buffer_.add(vectors, gltf::Target::vertices), gltf::Component::single,
                        "VEC3", vectors.size());
  }

  template <class T>
  std::size_t add_numbers(const std::vector<T>& values) {
    std::vector<float> floats;
    floats.reserve(values.size());
    for (const T value : values) floats.push_back(static_cast<float>(value));
    return add_accessor(buffer_.add(floats, gltf::Target::vertices), gltf::Component::single,
                        "SCALAR", floats.size());
  }

  std::size_t add_colours(const MassSpringModel& model) {
    std::vector<Byte4> of_material;
    const auto byte = [](float c) {
      return static_cast<std::uint8_t>(
          std::lround(255 * std::clamp(linear_component(c), 0.0, 1.0)));
    };
    for (std::uint32_t m = 0; m < model.materials.size(); ++m) {
      const Colour colour = drawn_colour(model.materials, m);
      of_material.push_back({byte(colour.r), byte(colour.g), byte(colour.b), 255});
    }
    std::vector<Byte4> colours;
    colours.reserve(model.material.size());
    for (const std::uint32_t material : model.material) colours.push_back(of_material[material]);
    const std::size_t accessor =
        add_accessor(buffer_.add(colours, gltf::Target::vertices), gltf::Component::unsigned_byte,
                     "VEC4", colours.size());
    document_["accessors"][accessor]["normalized"] = true;
    return accessor;
  }

  json level_primitives(const MassSpringModel& model, std::optional<std::size_t> spring_ends) {
    // In this order the arrays follow each other in the buffer.
    const std::size_t positions = add_positions(model.rest);
    const std::size_t colours = add_colours(model);
    json points{{"POSITION", positions}, {"COLOR_0", colours}};
    points["_MASS"] = add_numbers(model.mass);
    points["_VOLUME"] = add_numbers(model.volume);
    points["_BORDER"] = add_numbers(model.border);
    points["_MATERIAL"] = add_numbers(model.material);
    json primitives = json::array();
    primitives.push_back({{"mode", gltf::Mode::points}, {"attributes", std::move(points)}});
    if (spring_ends)
      primitives.push_back({{"mode", gltf::Mode::lines},
                            {"attributes", {{"POSITION", positions}, {"COLOR_0", colours}}},
                            {"indices", add_accessor(*spring_ends, gltf::Component::unsigned_int,
                                                     "SCALAR", model.end_count())}});
    return primitives;
  }

  json surface_primitives(const LodAsset& asset) {
    const TriangleMesh& surface = asset.surface;
    const SplitSurface shaded = split_at_creases(surface);
    std::vector<Vec3> points;
    points.reserve(shaded.source.size());
    for (const std::uint32_t v : shaded.source) points.push_back(surface.positions[v]);
    const std::size_t positions = add_positions(points);
    const std::size_t normals = add_vectors(normals_for_gltf(shaded, surface.positions));
    const std::size_t triangles = buffer_.add(shaded.triangles, gltf::Target::indices);
    return part_primitives(asset, {{"POSITION", positions}, {"NORMAL", normals}}, triangles,
                           gltf::Component::unsigned_int);
  }

  AssetBuffer& buffer_;
};

/// The scene of a slim asset.
class SlimDisplay : private Scene {
 public:
  using Scene::Scene;

  void add(const LodAsset& asset, const json& extension) {
    if (!asset.surface.triangles.empty()) {
      const json& surface = extension.at("surface");
      const json attributes{
          {"POSITION", positions_of(surface.at("positions"), asset.surface.positions)}};
      const json& indices = surface.at("indices");
      add_node("surface",
               part_primitives(asset, attributes, indices.at("view"), component_of(indices)), 0);
      return;
    }
    const MassSpringModel& model = asset.chain.levels[0].model;
    const json& level = extension.at("levels").at(0);
    const json attributes{{"POSITION", positions_of(level.at("rest"), model.rest)}};
    json primitives = json::array();
    primitives.push_back({{"mode", gltf::Mode::points}, {"attributes", attributes}});
    if (model.spring_count() > 0) {
      const json& ends = level.at("ends");
      primitives.push_back({{"mode", gltf::Mode::lines},
                            {"attributes", attributes},
                            {"indices", add_accessor(ends.at("view"), component_of(ends), "SCALAR",
                                                     model.end_count())}});
    }
    add_node("level 0", std::move(primitives), 0);
  }

 private:
  std::size_t positions_of(const json& array, const std::vector<Vec3>& points) {
    const std::size_t accessor =
        add_accessor(array.at("view"), gltf::Component::single, "VEC3", points.size());
    set_bounds(accessor, single_precision(points));
    return accessor;
  }
};

}  // namespace

void add_slim_display(const LodAsset& asset, const json& extension, json& document) {
  SlimDisplay(document).add(asset, extension);
}

void add_display(const LodAsset& asset, const SpringEnds& spring_ends, json& document,
                 AssetBuffer& buffer) {
  Display(document, buffer).add(asset, spring_ends);
}

}  // namespace springlod::inline model
