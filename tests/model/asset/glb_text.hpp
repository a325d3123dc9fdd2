#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <string>

#include <catch2/catch.hpp>

namespace springlod::test {

/// Parts of a .glb file: [begin, end) of the JSON text and of the binary chunk.
struct Layout {
  std::size_t json_begin = 20, json_end = 0, binary_begin = 0;
  explicit Layout(const std::string& file) {
    std::uint32_t length = 0;
    std::memcpy(&length, file.data() + 12, 4);
    json_end = json_begin + length;
    binary_begin = json_end + 8;
  }
};

/// The file with changed JSON text and corrected lengths.
inline std::string with_json(const std::string& file, const std::string& from,
                             const std::string& to) {
  const Layout layout(file);
  std::string json = file.substr(layout.json_begin, layout.json_end - layout.json_begin);
  REQUIRE(json.find(from) != std::string::npos);
  json.replace(json.find(from), from.size(), to);
  while (json.size() % 4 != 0) json += ' ';
  std::string changed = file.substr(0, layout.json_begin) + json + file.substr(layout.json_end);
  const auto json_length = static_cast<std::uint32_t>(json.size());
  const auto length = static_cast<std::uint32_t>(changed.size());
  std::memcpy(changed.data() + 8, &length, 4);
  std::memcpy(changed.data() + 12, &json_length, 4);
  return changed;
}

}  // namespace springlod::test
