#pragma once

#include <array>
#include <cstddef>
#include <map>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "model/asset/asset_buffer.hpp"
#include "model/asset/glb.hpp"
#include "model/asset/gltf_values.hpp"
#include "model/material.hpp"
#include "model/vec.hpp"

namespace springlod::inline model {

/// Builds a binary glTF 2.0 of one buffer: the lists of its document, and accessors to arrays. Each
/// add_ function and `append` return the number of what they added.
class GltfBuilder {
 public:
  /// Arrays start at multiples of `alignment` [bytes], which is at least the size of their
  /// components.
  explicit GltfBuilder(std::size_t alignment = sizeof(float)) : buffer_(alignment) {}

  nlohmann::json& document() { return document_; }
  AssetBuffer& buffer() { return buffer_; }

  /// Adds an entry to a list of the document.
  std::size_t append(const char* list, nlohmann::json entry);

  /// Refers to `count` elements of a view of the buffer.
  std::size_t add_accessor(std::size_t view, gltf::Component component, const char* type,
                           std::size_t count);
  /// An array, and the accessor to it. The array must not be empty.
  template <class T>
  std::size_t add_array(const std::vector<T>& values, gltf::Target target = gltf::Target::none) {
    return add_accessor(buffer_.add(values, target), gltf::Element<T>::component,
                        gltf::Element<T>::type, values.size());
  }
  /// In single precision.
  std::size_t add_array(const std::vector<Vec3>& vectors, gltf::Target target = gltf::Target::none);
  /// Of vertices, with their bounds.
  std::size_t add_positions(const std::vector<Vec3>& points);
  std::size_t add_times(const std::vector<double>& seconds);  ///< of an animation
  /// "min" and "max", which glTF requires of positions. `points`: not empty.
  void set_bounds(std::size_t accessor, const std::vector<std::array<float, 3>>& points);

  /// A dull material of this display colour; the one of this name, if there is one.
  std::size_t add_material(const std::string& name, const Colour& colour);

  /// Shows these nodes.
  void set_scene(const std::vector<std::size_t>& roots);

  /// Completes the document. The pieces refer to the buffer, of at most kLargestGlbBuffer.
  GlbPieces pieces();

 private:
  nlohmann::json document_{{"asset", {{"version", "2.0"}, {"generator", "springlod"}}}};
  AssetBuffer buffer_;
  std::map<std::string, std::size_t> material_of_name_;
};

}  // namespace springlod::inline model
