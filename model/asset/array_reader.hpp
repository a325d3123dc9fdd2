#pragma once

#include <cstdint>
#include <cstring>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include <fmt/format.h>

#include "model/asset/asset_format.hpp"
#include "model/asset/checksum.hpp"
#include "model/asset/field_reader.hpp"
#include "model/asset/glb.hpp"
#include "model/vec.hpp"

namespace springlod::inline model {

/// Copies the arrays of an asset out of the binary chunk of its file, and adds each to the
/// checksum of versions 1 to 5. The size of an array is checked before any memory is allocated for
/// it, and all arrays together are at most as large as the chunk: a small file cannot ask for much
/// memory by naming one array many times. Members throw Damage or InputError.
class ArrayReader {
 public:
  /// `gltf` and `binary` must live as long as the reader. `version`: of the asset.
  ArrayReader(const nlohmann::json& gltf, std::string_view binary, std::uint32_t version)
      : views_(gltf.at("bufferViews")),
        binary_(binary),
        untaken_(binary.size()),
        version_(version) {}

  /// The array that the field `key` of `object` refers to, which must have `count` entries. Empty
  /// arrays have no field.
  template <class T>
  std::vector<T> take(const FieldReader& object, const char* key, std::uint64_t count) {
    if (is_described(object, key)) {
      constexpr std::size_t kWidth = asset_format::kWidthOf<T>;
      const DescribedArray array = described_array(object, key, kWidth);
      if (array.bytes.size() != count * kWidth * array.size)
        throw Damage(fmt::format("its array {} has {} bytes, but {} entries need {}", key,
                                 array.bytes.size(), count, count * kWidth * array.size));
      return unpack<T>(array, key);
    }
    const std::string_view bytes = view(object, key);
    if (bytes.size() != count * sizeof(T))
      throw Damage(fmt::format("its array {} has {} bytes, but {} entries need {}", key,
                               bytes.size(), count, count * sizeof(T)));
    return copy<T>(bytes);
  }
  /// An array whose number of entries stands nowhere else.
  template <class T>
  std::vector<T> take_any(const FieldReader& object, const char* key) {
    if (is_described(object, key))
      return unpack<T>(described_array(object, key, asset_format::kWidthOf<T>), key);
    const std::string_view bytes = view(object, key);
    if (bytes.size() % sizeof(T) != 0) throw Damage(fmt::format("its array {} is cut short", key));
    return copy<T>(bytes);
  }

  /// Whether the array is empty: an empty list, or nothing in versions before 6.
  static bool is_empty(const FieldReader& object, const char* key) {
    return !object.has(key) || object.is_empty_list(key);
  }

  void add_to_checksum(std::string_view bytes) {
    if (version_ < asset_format::kVersionWithCrc) checksum_.add(bytes);
  }
  std::string old_checksum() const { return checksum_.text(); }

 private:
  /// Whether the array is an object, instead of the number of its view. Before slim assets, none
  /// was; since version 6, all are that are not empty.
  bool is_described(const FieldReader& object, const char* key) const {
    const bool described = object.is_object(key);
    if (described ? version_ < asset_format::kVersionWithSlim
                  : version_ >= asset_format::kVersionWithCrc && !is_empty(object, key))
      throw Damage(
          fmt::format("its array {} must be {}", key, described ? "a number" : "an object"));
    return described;
  }

  std::string_view view(const FieldReader& object, const char* key) {
    return is_empty(object, key) ? std::string_view() : bytes_of(object.count(key), key);
  }

  std::string_view bytes_of(std::uint32_t number, const char* key) {
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
    add_to_checksum(bytes);
    std::vector<T> array(bytes.size() / sizeof(T));
    if (!bytes.empty()) std::memcpy(static_cast<void*>(array.data()), bytes.data(), bytes.size());
    return array;
  }

  /// An array that is an object (docs/asset-format.md).
  struct DescribedArray {
    std::string type;
    std::size_t size = 0;  ///< of a number [bytes]
    std::string_view bytes;
    double scale = 1;
    std::vector<float> table;  ///< empty: the numbers are the values
    bool has_table = false;
  };

  /// `width`: what it must have; versions before 6 do not state it.
  DescribedArray described_array(const FieldReader& object, const char* key, std::size_t width) {
    const FieldReader place = object.nested(key);
    DescribedArray array;
    array.type = place.text("type");
    array.size = size_of(array.type);
    if (array.size == 0)
      throw Damage(fmt::format("its array {} is of the unknown type {}", key, array.type));
    if (version_ >= asset_format::kVersionWithCrc &&
        (place.has("width") ? place.count("width") : 1) != width)
      throw Damage(fmt::format("the entries of its array {} must have {} numbers", key, width));
    array.bytes = bytes_of(place.count("view"), key);
    add_to_checksum(array.bytes);
    if (array.bytes.size() % array.size != 0)
      throw Damage(fmt::format("its array {} is cut short", key));
    array.scale = place.optional_number("scale").value_or(1);
    array.has_table = place.has("table");
    if (array.has_table) {
      const std::string_view table = bytes_of(place.count("table"), key);
      if (table.size() % sizeof(float) != 0)
        throw Damage(fmt::format("the table of its array {} is cut short", key));
      array.table = copy<float>(table);
    }
    return array;
  }

  static std::size_t size_of(const std::string& type) {
    if (type == "float64") return 8;
    if (type == "float32" || type == "uint32") return 4;
    if (type == "uint16" || type == "int16") return 2;
    return type == "uint8" ? 1 : 0;
  }

  template <class T>
  static std::vector<T> unpack(const DescribedArray& array, const char* key) {
    if (array.type == "float64") return unpack_as<double, T>(array, key);
    if (array.type == "float32") return unpack_as<float, T>(array, key);
    if (array.type == "uint32") return unpack_as<std::uint32_t, T>(array, key);
    if (array.type == "uint16") return unpack_as<std::uint16_t, T>(array, key);
    if (array.type == "int16") return unpack_as<std::int16_t, T>(array, key);
    return unpack_as<std::uint8_t, T>(array, key);
  }

  /// Tuples are packed tightly. Integers must be stored as integers without sign.
  template <class Stored, class T>
  static std::vector<T> unpack_as(const DescribedArray& array, const char* key) {
    using Scalar = asset_format::ScalarOf<T>;
    constexpr std::size_t kWidth = asset_format::kWidthOf<T>;
    constexpr bool kFits = std::is_floating_point_v<Scalar> ||
                           (std::is_unsigned_v<Stored> && sizeof(Stored) <= sizeof(Scalar));
    if (!kFits || (!std::is_floating_point_v<Scalar> && (array.scale != 1 || array.has_table)))
      throw Damage(fmt::format("its array {} cannot be of the type {}", key, array.type));
    const std::size_t count = array.bytes.size() / sizeof(Stored);
    if (count % kWidth != 0) throw Damage(fmt::format("its array {} is cut short", key));
    std::vector<T> values(count / kWidth);
    for (std::size_t i = 0; i < count; ++i) {
      Stored stored;
      std::memcpy(&stored, array.bytes.data() + i * sizeof stored, sizeof stored);
      Scalar value = static_cast<Scalar>(stored);
      if constexpr (std::is_floating_point_v<Scalar>) {
        value *= array.scale;
        if (array.has_table) {
          if (!(value >= 0 && value < static_cast<double>(array.table.size())))
            throw Damage(fmt::format("its array {} refers to a value that does not exist", key));
          value = static_cast<double>(array.table[static_cast<std::size_t>(value)]);
        }
      }
      std::memcpy(reinterpret_cast<char*>(values.data()) + i * sizeof value, &value, sizeof value);
    }
    return values;
  }

  const nlohmann::json& views_;
  std::string_view binary_;
  std::uint64_t untaken_;  // [bytes]
  std::uint32_t version_;
  OldChecksum checksum_;
};

}  // namespace springlod::inline model
