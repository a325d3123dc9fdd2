#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include <nlohmann/json.hpp>

#include "model/asset/asset_buffer.hpp"
#include "model/asset/asset_format.hpp"
#include "model/vec.hpp"

namespace springlod::inline model {

/// Writes arrays in the smallest type that holds their values, and describes them as slim assets do
/// (docs/asset-format.md): {"view": 3, "type": "uint16"}. The arrays must not be empty.
class SmallArrays {
 public:
  explicit SmallArrays(AssetBuffer& buffer) : buffer_(buffer) {}

  /// Single precision, three a vector.
  nlohmann::json vectors(const std::vector<Vec3>& values, gltf::Target target);
  /// Single precision; or, if they have few values, a table of these and their numbers in it.
  nlohmann::json numbers(const std::vector<double>& values);
  /// Multiples of a power of 2 that fit into 16 bits.
  nlohmann::json weights(const std::vector<double>& values);
  /// Unsigned integers of 8, 16 or 32 bits. The largest value of a type is not used: glTF reserves
  /// it for indices.
  nlohmann::json integers(const std::uint32_t* values, std::size_t count, gltf::Target target);

 private:
  template <class T>
  nlohmann::json add_as(const char* type, const std::uint32_t* values, std::size_t count,
                        gltf::Target target);

  AssetBuffer& buffer_;
};

}  // namespace springlod::inline model
