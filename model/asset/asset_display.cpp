#include "model/asset/asset_display.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <utility>

#include <fmt/format.h>

#include "model/asset/gltf_surface.hpp"
#include "model/asset/gltf_values.hpp"
#include "model/creases.hpp"
#include "model/drawn_colour.hpp"

namespace springlod::inline model {
namespace {

using nlohmann::json;
using Byte4 = std::array<std::uint8_t, 4>;

/// Distance between levels along x, in widths of the base.
constexpr double kGap = 1.25;
// Least width that counts for it, as a fraction of the size [1].
constexpr double kLeastWidth = 0.1;

/// The component type of an array of integers in a slim asset.
gltf::Component component_of(const json& array) {
  const json& type = array.at("type");
  return type == "uint8"    ? gltf::Component::unsigned_byte
         : type == "uint16" ? gltf::Component::unsigned_short
                            : gltf::Component::unsigned_int;
}

/// The part of the scene that every asset has.
class Scene {
 public:
  explicit Scene(GltfBuilder& gltf) : gltf_(gltf), root_(gltf.append("nodes", z_up_node())) {
    gltf_.set_scene({root_});
  }

 protected:
  void add_node(const std::string& name, json primitives, double shift) {
    const std::size_t mesh =
        gltf_.append("meshes", {{"name", name}, {"primitives", std::move(primitives)}});
    json node{{"name", name}, {"mesh", mesh}};
    if (shift != 0) node["translation"] = {shift, 0.0, 0.0};
    const std::size_t number = gltf_.append("nodes", std::move(node));
    gltf_.document()["nodes"][root_]["children"].push_back(number);
  }

  json surface_parts(const LodAsset& asset, const json& attributes, const IndexView& triangles) {
    return part_primitives(gltf_, asset.surface.parts, asset.chain.levels[0].model.materials,
                           attributes, triangles);
  }

  GltfBuilder& gltf_;

 private:
  std::size_t root_;
};

class Display : private Scene {
 public:
  using Scene::Scene;

  void add(const LodAsset& asset, const json& extension) {
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
               level_primitives(model, extension.at("levels").at(n)), shift);
    }
  }

 private:
  template <class T>
  std::size_t add_numbers(const std::vector<T>& values) {
    std::vector<float> floats;
    floats.reserve(values.size());
    for (const T value : values) floats.push_back(static_cast<float>(value));
    return gltf_.add_array(floats, gltf::Target::vertices);
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
    const std::size_t accessor = gltf_.add_array(colours, gltf::Target::vertices);
    gltf_.document()["accessors"][accessor]["normalized"] = true;
    return accessor;
  }

  json level_primitives(const MassSpringModel& model, const json& level) {
    // In this order the arrays follow each other in the buffer.
    const std::size_t positions = gltf_.add_positions(model.rest);
    const std::size_t colours = add_colours(model);
    json points{{"POSITION", positions}, {"COLOR_0", colours}};
    points["_MASS"] = add_numbers(model.mass);
    points["_VOLUME"] = add_numbers(model.volume);
    points["_BORDER"] = add_numbers(model.border);
    points["_MATERIAL"] = add_numbers(model.material);
    json primitives = json::array();
    primitives.push_back({{"mode", gltf::Mode::points}, {"attributes", std::move(points)}});
    if (model.spring_count() > 0)
      primitives.push_back({{"mode", gltf::Mode::lines},
                            {"attributes", {{"POSITION", positions}, {"COLOR_0", colours}}},
                            {"indices", gltf_.add_accessor(level.at("ends").at("view"),
                                                           gltf::Component::unsigned_int, "SCALAR",
                                                           model.end_count())}});
    return primitives;
  }

  json surface_primitives(const LodAsset& asset) {
    const TriangleMesh& surface = asset.surface;
    const SplitSurface shaded = split_at_creases(surface);
    const std::size_t positions = gltf_.add_positions(drawn_positions(shaded, surface.positions));
    const std::size_t normals =
        gltf_.add_array(drawn_normals(shaded, surface.positions), gltf::Target::vertices);
    return surface_parts(asset, {{"POSITION", positions}, {"NORMAL", normals}},
                         add_triangles(gltf_, shaded.triangles));
  }
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
               surface_parts(asset, attributes, {indices.at("view"), component_of(indices)}), 0);
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
                            {"indices", gltf_.add_accessor(ends.at("view"), component_of(ends),
                                                           "SCALAR", model.end_count())}});
    }
    add_node("level 0", std::move(primitives), 0);
  }

 private:
  std::size_t positions_of(const json& array, const std::vector<Vec3>& points) {
    const std::size_t accessor =
        gltf_.add_accessor(array.at("view"), gltf::Component::single, "VEC3", points.size());
    gltf_.set_bounds(accessor, single_precision(points));
    return accessor;
  }
};

}  // namespace

void add_slim_display(const LodAsset& asset, const json& extension, GltfBuilder& gltf) {
  SlimDisplay(gltf).add(asset, extension);
}

void add_display(const LodAsset& asset, const json& extension, GltfBuilder& gltf) {
  Display(gltf).add(asset, extension);
}

}  // namespace springlod::inline model
