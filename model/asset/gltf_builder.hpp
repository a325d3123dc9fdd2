#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "model/material.hpp"
#include "model/mesh.hpp"
#include "model/vec.hpp"

namespace springlod::inline model {

/// Builds a binary glTF 2.0 of one buffer: the lists of its document, and accessors to arrays. Each
/// add_ function returns the number of what it added.
class GltfBuilder {
 public:
  using Joints = std::array<std::uint16_t, 4>;
  using Float4 = std::array<float, 4>;

  /// Adds an entry to a list of the document.
  std::size_t append(const char* list, nlohmann::json entry);
  nlohmann::json& document() { return document_; }

  // Vertices, in single precision.
  std::size_t add_positions(const std::vector<Vec3>& points);  ///< with their bounds
  std::size_t add_vectors(const std::vector<Vec3>& vectors);
  std::size_t add_joints(const std::vector<Joints>& joints);
  std::size_t add_weights(const std::vector<Float4>& weights);
  /// Triangles first .. first + count - 1 of an index array, which add_triangles added.
  std::size_t add_indices(std::size_t view, std::size_t first, std::size_t count);
  std::size_t add_triangles(const std::vector<Triangle>& triangles);  ///< a buffer view

  // Animations and skins.
  std::size_t add_times(const std::vector<double>& seconds);
  std::size_t add_track(const std::vector<Vec3>& values);
  std::size_t add_track(const std::vector<Float4>& values);
  std::size_t add_track(const std::vector<float>& values);
  std::size_t add_matrices(const std::vector<std::array<float, 16>>& matrices);  ///< by columns

  /// A dull material of this display colour.
  std::size_t add_material(const std::string& name, const Colour& colour);

  /// The file. Throws InputError beyond 4 GB.
  std::string glb() const;

 private:
  enum class Use { data, vertices, indices };
  std::size_t add_view(const void* data, std::size_t bytes, Use use);
  template <class T>
  std::size_t add_array(const std::vector<T>& array, int component, const char* type, Use use);

  nlohmann::json document_{{"asset", {{"version", "2.0"}, {"generator", "springlod"}}}};
  std::vector<unsigned char> bytes_;
};

}  // namespace springlod::inline model
