#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include "base/error.hpp"
#include "model/vec.hpp"

namespace springlod::inline model {

/// Numbers, and arrays of them such as Triangle: their bytes are their values.
template <class T>
inline constexpr bool kPackable = std::is_arithmetic_v<T>;
template <class T, std::size_t n>
inline constexpr bool kPackable<std::array<T, n>> = std::is_arithmetic_v<T>;

/// Serializes numbers to bytes in the byte order of the machine: for hashes, and for files that are
/// read on the same machine.
class Packer {
  static_assert(sizeof(Vec3) == 3 * sizeof(double), "vectors in a list follow directly");

 public:
  template <class T>
  requires std::is_arithmetic_v<T>
  void add(T value) { append(&value, sizeof value); }
  void add(std::string_view text) { add(std::span<const char>(text.data(), text.size())); }
  /// Adds the count, then the values.
  template <class T>
  requires kPackable<T>
  void add(std::span<const T> values) {
    add(static_cast<std::uint64_t>(values.size()));
    append(values.data(), values.size_bytes());
  }
  template <class T>
  requires kPackable<T>
  void add(const std::vector<T>& values) { add(std::span<const T>(values)); }
  void add(const std::vector<Vec3>& vectors) {
    add(static_cast<std::uint64_t>(vectors.size()));
    append(vectors.data(), vectors.size() * sizeof(Vec3));
  }

  const std::string& bytes() const { return bytes_; }

 private:
  void append(const void* data, std::size_t size) {
    if (size > 0) bytes_.append(static_cast<const char*>(data), size);
  }

  std::string bytes_;
};

/// Reads values in the order in which a Packer added them. All members throw IoError if the bytes
/// end too soon.
class Unpacker {
 public:
  explicit Unpacker(std::string_view bytes) : bytes_(bytes) {}

  template <class T>
  requires std::is_arithmetic_v<T> T take() {
    T value{};
    std::memcpy(&value, next(1, sizeof value), sizeof value);
    return value;
  }
  template <class T>
  requires kPackable<T> std::vector<T> take_list() {
    const auto count = take<std::uint64_t>();
    const char* from = next(count, sizeof(T));
    std::vector<T> values(count);
    if (count > 0) std::memcpy(values.data(), from, count * sizeof(T));
    return values;
  }
  std::vector<Vec3> take_vectors() {
    const auto count = take<std::uint64_t>();
    const char* from = next(count, sizeof(Vec3));
    std::vector<Vec3> vectors(count);
    if (count > 0) std::memcpy(vectors.front().data(), from, count * sizeof(Vec3));
    return vectors;
  }
  std::string take_text() {
    const std::vector<char> text = take_list<char>();
    return {text.begin(), text.end()};
  }

 private:
  const char* next(std::uint64_t count, std::size_t size) {
    if (count > bytes_.size() / size) throw IoError("packed numbers: the bytes end too soon");
    const char* here = bytes_.data();
    bytes_.remove_prefix(count * size);
    return here;
  }

  std::string_view bytes_;
};

}  // namespace springlod::inline model
