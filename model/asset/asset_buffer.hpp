#pragma once

#include <cstddef>
#include <type_traits>
#include <utility>
#include <vector>

#include <nlohmann/json.hpp>

#include "model/asset/gltf_values.hpp"

namespace springlod::inline model {

/// Collects arrays in the single buffer of a .glb file and numbers their buffer views.
class AssetBuffer {
 public:
  /// Accessors must start at multiples of their elements; the widest one is a double.
  explicit AssetBuffer(std::size_t alignment = sizeof(double)) : alignment_(alignment) {}

  void reserve(std::size_t bytes) { bytes_.reserve(bytes); }

  /// The array must not be empty: glTF has no empty views.
  template <class T>
  std::size_t add(const std::vector<T>& array, gltf::Target target = gltf::Target::none) {
    static_assert(std::is_standard_layout_v<T>);
    bytes_.resize((bytes_.size() + alignment_ - 1) / alignment_ * alignment_, 0);
    nlohmann::json view{{"buffer", 0}, {"byteLength", array.size() * sizeof(T)}};
    if (!bytes_.empty()) view["byteOffset"] = bytes_.size();
    if (target != gltf::Target::none) view["target"] = target;
    const auto* bytes = reinterpret_cast<const unsigned char*>(array.data());
    bytes_.insert(bytes_.end(), bytes, bytes + array.size() * sizeof(T));
    views_.push_back(std::move(view));
    return views_.size() - 1;
  }

  const std::vector<unsigned char>& bytes() const { return bytes_; }
  /// "bufferViews" of the glTF document.
  const nlohmann::json& views() const { return views_; }

 private:
  std::size_t alignment_;  // [bytes]
  std::vector<unsigned char> bytes_;
  nlohmann::json views_ = nlohmann::json::array();
};

}  // namespace springlod::inline model
