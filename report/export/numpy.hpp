#pragma once

#include <bit>
#include <cstdint>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include "model/vec.hpp"
#include "report/export/zip.hpp"

namespace springlod::report {

static_assert(std::endian::native == std::endian::little,
              "arrays are copied as they are in memory");

/// Arrays of a .npz file, under the names that numpy.load finds them by.
class NumpyArrays {
 public:
  /// A vector, or with `columns` an array of rows of that many values.
  template <class T>
  void add(const std::string& name, const std::vector<T>& values, std::size_t columns = 0) {
    static_assert(std::is_arithmetic_v<T>);
    add_bytes(name, kind_of<T>(), values.data(), sizeof(T), values.size(), columns);
  }
  /// P rows of 3.
  void add(const std::string& name, const std::vector<Vec3>& points);
  /// F frames of P rows of 3; all frames have as many points.
  void add(const std::string& name, const std::vector<std::vector<Vec3>>& frames);
  /// UTF-8 in bytes (numpy's dtype S).
  void add(const std::string& name, const std::vector<std::string>& texts);

  /// The bytes of the .npz file.
  std::string file() const { return zip_archive(entries_); }

 private:
  template <class T>
  static constexpr char kind_of() {
    return std::is_floating_point_v<T> ? 'f' : std::is_signed_v<T> ? 'i' : 'u';
  }
  /// `kind`: of numpy's dtype: f, i, u or S; `size`: of a value.
  void add_bytes(const std::string& name, char kind, const void* values, std::size_t size,
                 std::size_t count, std::size_t columns);
  /// `type`: numpy's; `shape`: as in a Python tuple without its brackets.
  void add_entry(const std::string& name, const std::string& type, const std::string& shape,
                 std::string_view values);

  std::vector<ZipEntry> entries_;
};

}  // namespace springlod::report
