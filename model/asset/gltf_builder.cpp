#include "model/asset/gltf_builder.hpp"

#include <algorithm>
#include <utility>

#include "model/asset/glb.hpp"

namespace springlod::inline model {

using nlohmann::json;
using Float3 = std::array<float, 3>;

std::size_t GltfBuilder::append(const char* list, json entry) {
  document_[list].push_back(std::move(entry));
  return document_[list].size() - 1;
}

std::size_t GltfBuilder::add_accessor(std::size_t view, gltf::Component component, const char* type,
                                      std::size_t count) {
  return append(
      "accessors",
      {{"bufferView", view}, {"componentType", component}, {"type", type}, {"count", count}});
}

std::size_t GltfBuilder::add_array(const std::vector<Vec3>& vectors, gltf::Target target) {
  return add_array(single_precision(vectors), target);
}

std::size_t GltfBuilder::add_positions(const std::vector<Vec3>& points) {
  const std::vector<Float3> floats = single_precision(points);
  const std::size_t accessor = add_array(floats, gltf::Target::vertices);
  set_bounds(accessor, floats);
  return accessor;
}

std::size_t GltfBuilder::add_times(const std::vector<double>& seconds) {
  const std::vector<float> floats(seconds.begin(), seconds.end());
  const std::size_t accessor = add_array(floats);
  document_["accessors"][accessor]["min"] = {floats.front()};
  document_["accessors"][accessor]["max"] = {floats.back()};
  return accessor;
}

void GltfBuilder::set_bounds(std::size_t accessor, const std::vector<Float3>& points) {
  Float3 low = points.at(0), high = points.at(0);
  for (const Float3& p : points)
    for (std::size_t d = 0; d < 3; ++d) {
      low[d] = std::min(low[d], p[d]);
      high[d] = std::max(high[d], p[d]);
    }
  document_["accessors"][accessor]["min"] = low;
  document_["accessors"][accessor]["max"] = high;
}

std::size_t GltfBuilder::add_material(const std::string& name, const Colour& colour) {
  const auto known = material_of_name_.find(name);
  if (known != material_of_name_.end()) return known->second;
  return material_of_name_[name] = append("materials", gltf_material(name, colour));
}

void GltfBuilder::set_scene(const std::vector<std::size_t>& roots) {
  document_["scenes"] = {{{"nodes", roots}}};
  document_["scene"] = 0;
}

GlbPieces GltfBuilder::pieces() {
  document_["bufferViews"] = buffer_.views();
  document_["buffers"] = {{{"byteLength", buffer_.bytes().size()}}};
  return glb_pieces(document_, buffer_.bytes());
}

}  // namespace springlod::inline model
