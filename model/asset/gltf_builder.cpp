#include "model/asset/gltf_builder.hpp"

#include <algorithm>
#include <sstream>
#include <utility>

#include <fmt/format.h>

#include "base/error.hpp"
#include "model/asset/asset_format.hpp"
#include "model/asset/glb.hpp"
#include "model/asset/gltf_values.hpp"

namespace springlod::inline model {

namespace {

using nlohmann::json;
using Float3 = std::array<float, 3>;

// Accessors start at multiples of their components, of at most 4 bytes here.
constexpr std::size_t kAlignment = 4;

}  // namespace

std::size_t GltfBuilder::append(const char* list, json entry) {
  document_[list].push_back(std::move(entry));
  return document_[list].size() - 1;
}

std::size_t GltfBuilder::add_view(const void* data, std::size_t bytes, Use use) {
  bytes_.resize((bytes_.size() + kAlignment - 1) / kAlignment * kAlignment, 0);
  json view{{"buffer", 0}, {"byteOffset", bytes_.size()}, {"byteLength", bytes}};
  if (use != Use::data)
    view["target"] = use == Use::vertices ? gltf::Target::vertices : gltf::Target::indices;
  const auto* first = static_cast<const unsigned char*>(data);
  bytes_.insert(bytes_.end(), first, first + bytes);
  return append("bufferViews", std::move(view));
}

template <class T>
std::size_t GltfBuilder::add_array(const std::vector<T>& array, int component, const char* type,
                                   Use use) {
  return append("accessors", {{"bufferView", add_view(array.data(), array.size() * sizeof(T), use)},
                              {"componentType", component},
                              {"type", type},
                              {"count", array.size()}});
}

namespace {
constexpr int kSingle = static_cast<int>(gltf::Component::single);
constexpr int kUnsignedShort = 5123;
}  // namespace

std::size_t GltfBuilder::add_positions(const std::vector<Vec3>& points) {
  const std::vector<Float3> floats = single_precision(points);
  const std::size_t accessor = add_array(floats, kSingle, "VEC3", Use::vertices);
  Float3 low = floats.at(0), high = floats.at(0);
  for (const Float3& p : floats)
    for (std::size_t d = 0; d < 3; ++d) {
      low[d] = std::min(low[d], p[d]);
      high[d] = std::max(high[d], p[d]);
    }
  document_["accessors"][accessor]["min"] = low;
  document_["accessors"][accessor]["max"] = high;
  return accessor;
}

std::size_t GltfBuilder::add_vectors(const std::vector<Vec3>& vectors) {
  return add_array(single_precision(vectors), kSingle, "VEC3", Use::vertices);
}

std::size_t GltfBuilder::add_joints(const std::vector<Joints>& joints) {
  return add_array(joints, kUnsignedShort, "VEC4", Use::vertices);
}

std::size_t GltfBuilder::add_weights(const std::vector<Float4>& weights) {
  return add_array(weights, kSingle, "VEC4", Use::vertices);
}

std::size_t GltfBuilder::add_triangles(const std::vector<Triangle>& triangles) {
  return add_view(triangles.data(), triangles.size() * sizeof(Triangle), Use::indices);
}

std::size_t GltfBuilder::add_indices(std::size_t view, std::size_t first, std::size_t count) {
  json accessor{{"bufferView", view},
                {"componentType", gltf::Component::unsigned_int},
                {"type", "SCALAR"},
                {"count", 3 * count}};
  if (first > 0) accessor["byteOffset"] = sizeof(Triangle) * first;
  return append("accessors", std::move(accessor));
}

std::size_t GltfBuilder::add_times(const std::vector<double>& seconds) {
  const std::vector<float> floats(seconds.begin(), seconds.end());
  const std::size_t accessor = add_array(floats, kSingle, "SCALAR", Use::data);
  document_["accessors"][accessor]["min"] = {floats.front()};
  document_["accessors"][accessor]["max"] = {floats.back()};
  return accessor;
}

std::size_t GltfBuilder::add_track(const std::vector<Vec3>& values) {
  return add_array(single_precision(values), kSingle, "VEC3", Use::data);
}

std::size_t GltfBuilder::add_track(const std::vector<Float4>& values) {
  return add_array(values, kSingle, "VEC4", Use::data);
}

std::size_t GltfBuilder::add_track(const std::vector<float>& values) {
  return add_array(values, kSingle, "SCALAR", Use::data);
}

std::size_t GltfBuilder::add_matrices(const std::vector<std::array<float, 16>>& matrices) {
  return add_array(matrices, kSingle, "MAT4", Use::data);
}

std::size_t GltfBuilder::add_material(const std::string& name, const Colour& colour) {
  return append("materials", gltf_material(name, colour));
}

std::string GltfBuilder::glb() const {
  // Lengths in a .glb file have 32 bits; some room is left for the JSON.
  constexpr std::size_t kLargestBuffer = 0xF0000000;
  if (bytes_.size() > kLargestBuffer)
    throw InputError(fmt::format(
        "{} bytes do not fit into a .glb file (4 GB); take fewer frames or a coarser level",
        bytes_.size()));
  json document = document_;
  document["buffers"] = {{{"byteLength", bytes_.size()}}};
  std::ostringstream out;
  write_glb(out, document, bytes_);
  return std::move(out).str();
}

}  // namespace springlod::inline model
