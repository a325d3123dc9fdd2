#include "model/asset/glb.hpp"

#include <cstring>
#include <initializer_list>

#include <fmt/format.h>

namespace springlod::inline model {
namespace {

constexpr std::string_view kMagic = "glTF";
constexpr std::uint32_t kVersion = 2;
constexpr std::uint32_t kJson = 0x4E4F534A;
constexpr std::uint32_t kBinary = 0x004E4942;
constexpr std::size_t kHeader = 12;
constexpr std::size_t kChunkHeader = 8;
// Of the JSON chunk [bytes]. Parsed, it needs up to 20 times as much memory. An asset has some kB a
// level, most of them for its certificate.
constexpr std::size_t kLargestJson = std::size_t{64} << 20;
constexpr int kMostLevels = 64;  // of JSON; an asset has some 10

std::uint32_t word_at(std::string_view bytes, std::size_t offset) {
  std::uint32_t word = 0;
  std::memcpy(&word, bytes.data() + offset, sizeof word);
  return word;
}

/// Takes one chunk (length, type, data) off the front.
std::string_view take_chunk(std::string_view& rest, std::uint32_t type, const char* name) {
  if (rest.size() < kChunkHeader || word_at(rest, 4) != type)
    throw Damage(fmt::format("its {} chunk is missing", name));
  const std::size_t length = word_at(rest, 0);
  if (length > rest.size() - kChunkHeader)
    throw Damage(fmt::format("its {} chunk is cut short", name));
  const std::string_view chunk = rest.substr(kChunkHeader, length);
  rest.remove_prefix(kChunkHeader + length);
  return chunk;
}

// Parsers and destructors of JSON call themselves for each level.
void require_shallow(std::string_view json) {
  int depth = 0;
  bool in_text = false;
  for (std::size_t i = 0; i < json.size(); ++i) {
    const char c = json[i];
    if (in_text && c == '\\') {
      ++i;
    } else if (c == '"') {
      in_text = !in_text;
    } else if (!in_text && (c == '[' || c == '{')) {
      if (++depth > kMostLevels) throw Damage("its JSON chunk is nested too deeply");
    } else if (!in_text && (c == ']' || c == '}')) {
      --depth;
    }
  }
}

void add_words(std::string& to, std::initializer_list<std::size_t> words) {
  for (const std::size_t each : words) {
    const auto word = static_cast<std::uint32_t>(each);
    to.append(reinterpret_cast<const char*>(&word), sizeof word);
  }
}

/// Chunks are multiples of 4 bytes.
std::size_t padded(std::size_t size) {
  return (size + 3) / 4 * 4;
}

}  // namespace

bool is_glb(std::string_view file) {
  return file.size() >= kHeader + kChunkHeader && file.starts_with(kMagic);
}

GlbChunks split_glb(std::string_view file) {
  if (word_at(file, 4) != kVersion)
    throw Damage(fmt::format("it says glTF version {}, not 2", word_at(file, 4)));
  if (word_at(file, 8) != file.size())
    throw Damage(fmt::format("it has {} bytes and should have {}", file.size(), word_at(file, 8)));
  std::string_view rest = file.substr(kHeader);
  GlbChunks chunks;
  chunks.json = take_chunk(rest, kJson, "JSON");
  if (chunks.json.size() > kLargestJson)
    throw Damage(fmt::format("its JSON chunk has {} bytes; at most {} are read", chunks.json.size(),
                             kLargestJson));
  require_shallow(chunks.json);
  chunks.binary = take_chunk(rest, kBinary, "binary");
  return chunks;
}

std::string json_text(const nlohmann::json& value) {
  return value.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

GlbPieces glb_pieces(const nlohmann::json& document, const std::vector<unsigned char>& binary) {
  constexpr std::string_view kZeros("\0\0\0", 3);
  std::string text = json_text(document);
  text.resize(padded(text.size()), ' ');
  GlbPieces glb;
  glb.head = kMagic;
  add_words(glb.head, {kVersion, kHeader + 2 * kChunkHeader + text.size() + padded(binary.size())});
  add_words(glb.head, {text.size(), kJson});
  glb.head += text;
  add_words(glb.head, {padded(binary.size()), kBinary});
  glb.binary = {reinterpret_cast<const char*>(binary.data()), binary.size()};
  glb.padding = kZeros.substr(0, padded(binary.size()) - binary.size());
  return glb;
}

void write_glb(std::ostream& out, const GlbPieces& glb) {
  for (const std::string_view piece : {std::string_view(glb.head), glb.binary, glb.padding})
    out.write(piece.data(), static_cast<std::streamsize>(piece.size()));
}

}  // namespace springlod::inline model
