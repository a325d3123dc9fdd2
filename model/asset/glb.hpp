#pragma once

#include <cstddef>
#include <cstdint>
#include <ostream>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include <nlohmann/json.hpp>

namespace springlod::inline model {

// The container of binary glTF 2.0: a header of 12 bytes, a chunk of JSON text and a chunk of
// binary data.

/// Describes the damage of a .glb file, without the file name.
class Damage : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

struct GlbChunks {
  std::string_view json;
  std::string_view binary;
};

/// Whether the bytes begin as a .glb file does.
bool is_glb(std::string_view file);

/// Throws Damage unless `file`, for which is_glb holds, is whole. The chunks refer to it.
GlbChunks split_glb(std::string_view file);

/// JSON without white space, keys sorted. Names from mesh files may have any encoding, JSON is
/// UTF-8: other bytes become U+FFFD.
std::string json_text(const nlohmann::json& value);

/// Lengths in a .glb file have 32 bits; some room is left for the JSON [bytes].
inline constexpr std::size_t kLargestGlbBuffer = 0xF0000000;

/// A .glb file in pieces that follow each other.
struct GlbPieces {
  std::string head;  ///< what stands before the binary data, with the JSON text of the document
  std::string_view binary;
  std::string_view padding;  ///< of the binary data
};

/// The pieces refer to `binary`.
GlbPieces glb_pieces(const nlohmann::json& document, const std::vector<unsigned char>& binary);
void write_glb(std::ostream& out, const GlbPieces& glb);

}  // namespace springlod::inline model
