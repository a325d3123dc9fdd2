#pragma once

#include <cstdint>
#include <cstring>
#include <string>
#include <string_view>
#include <vector>

#include <fmt/format.h>

#include "model/asset/asset_format.hpp"
#include "model/asset/field_reader.hpp"
#include "model/asset/glb.hpp"

namespace springlod::inline model {

/// Copies the arrays of an asset out of the binary chunk of its file, and adds each to the
/// checksum. The size of an array is checked before any memory is allocated for it, and all arrays
/// together are at most as large as the chunk: a small file cannot ask for much memory by naming
/// one array many times. Members throw Damage or InputError.
class ArrayReader {
 public:
  /// `gltf` and `binary` must live as long as the reader.
  ArrayReader(const nlohmann::json& gltf, std::string_view binary)
      : views_(gltf.at("bufferViews")), binary_(binary), untaken_(binary.size()) {}

  /// The array that the field `key` of `object` refers to, which must have `count` entries. Empty
  /// arrays have no field.
  template <class T>
  std::vector<T> take(const FieldReader& object, const char* key, std::uint64_t count) {
    const std::string_view bytes = view(object, key);
    if (bytes.size() != count * sizeof(T))
      throw Damage(fmt::format("its array {} has {} bytes, but {} entries need {}", key,
                               bytes.size(), count, count * sizeof(T)));
    return copy<T>(bytes);
  }
  /// An array whose number of entries stands nowhere else.
  template <class T>
  std::vector<T> take_any(const FieldReader& object, const char* key) {
    const std::string_view bytes = view(object, key);
    if (bytes.size() % sizeof(T) != 0) throw Damage(fmt::format("its array {} is cut short", key));
    return copy<T>(bytes);
  }

  void add_to_checksum(std::string_view bytes) { checksum_.add(bytes); }
  std::string checksum() const { return checksum_.text(); }

 private:
  std::string_view view(const FieldReader& object, const char* key) {
    if (!object.has(key)) return {};
    const std::uint32_t number = object.count(key);
    if (number >= views_.size())
      throw Damage(
          fmt::format("its array {} refers to buffer view {} of {}", key, number, views_.size()));
    const FieldReader place(views_.at(number), fmt::format("buffer view {}", number));
    const std::uint64_t offset = place.has("byteOffset") ? place.count("byteOffset") : 0;
    const std::uint64_t length = place.count("byteLength");
    if (place.count("buffer") != 0 || offset > binary_.size() || length > binary_.size() - offset)
      throw Damage(fmt::format("its array {} lies outside the file", key));
    if (length > untaken_) throw Damage("its arrays overlap");
    untaken_ -= length;
    return binary_.substr(offset, length);
  }

  template <class T>
  std::vector<T> copy(std::string_view bytes) {
    checksum_.add(bytes);
    std::vector<T> array(bytes.size() / sizeof(T));
    if (!bytes.empty()) std::memcpy(static_cast<void*>(array.data()), bytes.data(), bytes.size());
    return array;
  }

  const nlohmann::json& views_;
  std::string_view binary_;
  std::uint64_t untaken_;  // [bytes]
  asset_format::Checksum checksum_;
};

}  // namespace springlod::inline model
