#pragma once

// The checksums of assets (docs/asset-format.md). They find accidental damage.

#include <cstdint>
#include <initializer_list>
#include <memory>
#include <string>
#include <string_view>

#include <xxhash.h>

namespace springlod::inline model {

/// "crc32:" and the digits of no checksum, in whose place they stand.
inline constexpr std::string_view kNoChecksum = "crc32:00000000";

/// CRC-32 (that of zlib) of the pieces, one after the other: "crc32:" and 8 hexadecimal digits.
std::string crc_text(std::initializer_list<std::string_view> pieces);

/// What must stand in a file that states `stated`: crc_text() of the file, with kNoChecksum where
/// `stated` stands first. Empty if it stands nowhere.
std::string checksum_of_file(std::string_view file, std::string_view stated);

/// Checksum of versions 1 to 5: xxh3-64 of the arrays in the order of writing, each preceded by its
/// length in bytes, and of the extension's JSON without the checksum.
class OldChecksum {
 public:
  OldChecksum();
  void add(std::string_view bytes);
  /// "xxh3-64:" and 16 hexadecimal digits.
  std::string text() const;

 private:
  std::unique_ptr<XXH3_state_t, decltype(&XXH3_freeState)> state_;
};

}  // namespace springlod::inline model
