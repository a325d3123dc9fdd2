#include "model/asset/checksum.hpp"

#include <fmt/format.h>
#include <zlib.h>

namespace springlod::inline model {

std::string crc_text(std::initializer_list<std::string_view> pieces) {
  auto crc = crc32_z(0, nullptr, 0);
  for (const std::string_view piece : pieces)
    crc = crc32_z(crc, reinterpret_cast<const Bytef*>(piece.data()), piece.size());
  return fmt::format("crc32:{:08x}", crc);
}

std::string checksum_of_file(std::string_view file, std::string_view stated) {
  const std::size_t at = file.find(stated);
  if (at == std::string_view::npos) return {};
  return crc_text({file.substr(0, at), kNoChecksum, file.substr(at + stated.size())});
}

OldChecksum::OldChecksum() : state_(XXH3_createState(), &XXH3_freeState) {
  XXH3_64bits_reset(state_.get());
}

void OldChecksum::add(std::string_view bytes) {
  const std::uint64_t length = bytes.size();
  XXH3_64bits_update(state_.get(), &length, sizeof length);
  XXH3_64bits_update(state_.get(), bytes.data(), bytes.size());
}

std::string OldChecksum::text() const {
  return fmt::format("xxh3-64:{:016x}", XXH3_64bits_digest(state_.get()));
}

}  // namespace springlod::inline model
