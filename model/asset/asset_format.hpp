#pragma once

// Constants and the checksum shared by the writer and the reader (docs/asset-format.md).

#include <bit>
#include <cstdint>
#include <memory>
#include <string>
#include <string_view>

#include <fmt/format.h>
#include <xxhash.h>

namespace springlod::inline model::asset_format {

static_assert(std::endian::native == std::endian::little,
              "arrays are copied from memory, and glTF is little-endian");

inline constexpr const char* kExtension = "SPRINGLOD_lod_chain";
inline constexpr int kVersion = 5;
/// The first version whose levels have corners.
inline constexpr int kVersionWithCorners = 2;
/// The first version whose materials have a Poisson's ratio and whose levels have dilatation terms.
/// Assets without are written as the version before, which older programs read.
inline constexpr int kVersionWithDilatation = 3;
/// The first version whose base may have a contact surface; others are written as before.
inline constexpr int kVersionWithSurface = 4;
/// The first version with slim assets, whose arrays have small types; whole ones are written as
/// before.
inline constexpr int kVersionWithSlim = 5;

/// xxh3-64 over the double-precision arrays in the order of writing, each preceded by its length in
/// bytes, and over the extension's JSON (keys sorted, no white space, without the checksum itself).
class Checksum {
 public:
  Checksum() : state_(XXH3_createState(), &XXH3_freeState) { XXH3_64bits_reset(state_.get()); }
  void add(std::string_view bytes) {
    const std::uint64_t length = bytes.size();
    XXH3_64bits_update(state_.get(), &length, sizeof length);
    XXH3_64bits_update(state_.get(), bytes.data(), bytes.size());
  }
  std::string text() const {
    return fmt::format("xxh3-64:{:016x}", XXH3_64bits_digest(state_.get()));
  }

 private:
  std::unique_ptr<XXH3_state_t, decltype(&XXH3_freeState)> state_;
};

}  // namespace springlod::inline model::asset_format
