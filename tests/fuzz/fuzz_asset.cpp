// Reads the bytes as an asset. The mutation run of assets also runs what is read.
//
// Its checksum is not verified (see FUZZING_BUILD_MODE_UNSAFE_FOR_PRODUCTION), and the lengths in
// its headers are corrected: random changes would hardly keep them right.

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

#include "base/error.hpp"
#include "model/asset/asset.hpp"

namespace {

void add_word(std::string& to, std::size_t value) {
  const auto word = static_cast<std::uint32_t>(value);
  to.append(reinterpret_cast<const char*>(&word), sizeof word);
}

/// As long as chunks of a .glb file must be: a multiple of 4 bytes.
std::string padded(std::string_view bytes, char with) {
  return std::string(bytes) + std::string((4 - bytes.size() % 4) % 4, with);
}

/// The file with lengths in its headers that fit its JSON and its arrays.
std::string with_lengths(std::string_view file) {
  constexpr std::string_view kBinary("BIN\0", 4);
  constexpr std::size_t kHeaders = 20;     // in front of the JSON [bytes]
  constexpr std::size_t kChunkHeader = 8;  // in front of the arrays [bytes]
  const std::size_t type = file.find(kBinary, kHeaders + 4);
  if (type == std::string_view::npos) return std::string(file);
  const std::string json = padded(file.substr(kHeaders, type - 4 - kHeaders), ' ');
  const std::string arrays = padded(file.substr(type + kBinary.size()), '\0');
  std::string corrected = "glTF";
  add_word(corrected, 2);
  add_word(corrected, kHeaders + json.size() + kChunkHeader + arrays.size());
  add_word(corrected, json.size());
  corrected += "JSON" + json;
  add_word(corrected, arrays.size());
  return corrected.append(kBinary) + arrays;
}

void read(std::string_view file) {
  try {
    springlod::parse_asset(file, "input.glb");
  } catch (const springlod::IoError&) {
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view input(reinterpret_cast<const char*>(data), size);
  read(input);
  read(with_lengths(input));
  return 0;
}
