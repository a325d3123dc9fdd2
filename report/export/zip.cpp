#include "report/export/zip.hpp"

#include <cstdint>
#include <limits>
#include <new>
#include <stdexcept>

#include <zlib.h>

#include "base/error.hpp"

// PKWARE's APPNOTE.TXT 6.3: a header before each file, then all headers again with their offsets.

namespace springlod::report {
namespace {

constexpr std::uint32_t kLocalHeader = 0x04034b50, kCentralHeader = 0x02014b50,
                        kEndOfArchive = 0x06054b50;
constexpr std::uint16_t kVersion = 20;  // 2.0: deflated files
constexpr std::uint16_t kDeflated = 8;
constexpr std::uint16_t kFirstDay = 0x21;  // 1980-01-01

template <class Integer>
void put(std::string& bytes, Integer value) {
  for (std::size_t i = 0; i < sizeof(Integer); ++i)
    bytes += static_cast<char>(static_cast<std::uint64_t>(value) >> (8 * i) & 0xFFU);
}

void require_small(std::size_t size) {
  if (size >= std::numeric_limits<std::uint32_t>::max())
    throw InputError("the level is too large for a zip archive (4 GiB); export it as vtk");
}

// Without the header and the checksum of zlib, which zip has in its own form.
std::string deflated(const std::string& content) {
  constexpr int kRaw = -15, kMemory = 8;
  z_stream stream{};
  if (deflateInit2(&stream, Z_DEFAULT_COMPRESSION, Z_DEFLATED, kRaw, kMemory, Z_DEFAULT_STRATEGY) !=
      Z_OK)
    throw std::bad_alloc();
  std::string packed(deflateBound(&stream, content.size()), '\0');
  stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(content.data()));
  stream.avail_in = static_cast<uInt>(content.size());
  stream.next_out = reinterpret_cast<Bytef*>(packed.data());
  stream.avail_out = static_cast<uInt>(packed.size());
  const int state = deflate(&stream, Z_FINISH);
  packed.resize(stream.total_out);
  deflateEnd(&stream);
  if (state != Z_STREAM_END) throw std::logic_error("zip: deflateBound is no bound");
  return packed;
}

// What the header of a file and its copy at the end have in common.
std::string common_fields(const ZipEntry& entry, std::size_t packed) {
  std::string fields;
  put(fields, kVersion);
  put(fields, std::uint16_t{0});  // flags
  put(fields, kDeflated);
  put(fields, std::uint16_t{0});  // time
  put(fields, kFirstDay);
  put(fields, static_cast<std::uint32_t>(crc32_z(
                  0, reinterpret_cast<const Bytef*>(entry.content.data()), entry.content.size())));
  put(fields, static_cast<std::uint32_t>(packed));
  put(fields, static_cast<std::uint32_t>(entry.content.size()));
  put(fields, static_cast<std::uint16_t>(entry.name.size()));
  put(fields, std::uint16_t{0});  // length of further fields
  return fields;
}

}  // namespace

std::string zip_archive(const std::vector<ZipEntry>& entries) {
  std::string archive, directory;
  for (const ZipEntry& entry : entries) {
    require_small(entry.content.size());
    const std::string packed = deflated(entry.content);
    const std::string fields = common_fields(entry, packed.size());
    put(directory, kCentralHeader);
    put(directory, kVersion);  // made by
    directory += fields;
    put(directory, std::uint16_t{0});  // length of the comment
    put(directory, std::uint16_t{0});  // number of the disk
    put(directory, std::uint16_t{0});  // internal attributes
    put(directory, std::uint32_t{0});  // external attributes
    put(directory, static_cast<std::uint32_t>(archive.size()));
    directory += entry.name;
    put(archive, kLocalHeader);
    archive += fields + entry.name + packed;
    require_small(archive.size());
  }
  const auto start = static_cast<std::uint32_t>(archive.size());
  archive += directory;
  put(archive, kEndOfArchive);
  put(archive, std::uint16_t{0});  // number of the disk
  put(archive, std::uint16_t{0});  // disk of the directory
  put(archive, static_cast<std::uint16_t>(entries.size()));
  put(archive, static_cast<std::uint16_t>(entries.size()));
  put(archive, static_cast<std::uint32_t>(directory.size()));
  put(archive, start);
  put(archive, std::uint16_t{0});  // length of the comment
  return archive;
}

}  // namespace springlod::report
