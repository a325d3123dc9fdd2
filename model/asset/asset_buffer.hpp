#pragma once

#include <cstdint>
#include <cstring>
#include <type_traits>
#include <vector>

#include <tiny_gltf.h>

namespace springlod::inline model {

/// The one buffer of a .glb file in the making: arrays go in, numbers of buffer views come out.
class AssetBuffer {
 public:
  explicit AssetBuffer(tinygltf::Model& gltf) : gltf_(gltf) { gltf_.buffers.resize(1); }

  void reserve(std::size_t bytes) { gltf_.buffers[0].data.reserve(bytes); }

  /// `target`: what WebGL uses the view for (TINYGLTF_TARGET_*), 0 for nothing. The array must not
  /// be empty: glTF has no empty views.
  template <class T>
  int add(const std::vector<T>& array, int target = 0) {
    static_assert(std::is_standard_layout_v<T>);
    auto& data = gltf_.buffers[0].data;
    // The widest element is a double, and accessors must start at multiples of their elements.
    constexpr std::size_t kAlignment = 8;
    data.resize((data.size() + kAlignment - 1) / kAlignment * kAlignment, 0);
    tinygltf::BufferView view;
    view.buffer = 0;
    view.byteOffset = data.size();
    view.byteLength = array.size() * sizeof(T);
    view.target = target;
    const auto* bytes = reinterpret_cast<const unsigned char*>(array.data());
    data.insert(data.end(), bytes, bytes + view.byteLength);
    gltf_.bufferViews.push_back(std::move(view));
    return static_cast<int>(gltf_.bufferViews.size()) - 1;
  }

 private:
  tinygltf::Model& gltf_;
};

}  // namespace springlod::inline model
