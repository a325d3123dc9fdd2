#include "base/file.hpp"

#include <cerrno>
#include <cstring>
#include <fstream>
#include <iterator>
#include <system_error>

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>
#include <xxhash.h>

#include "base/descriptor.hpp"
#include "base/error.hpp"
#include "base/temporary_file.hpp"

namespace springlod::inline base {

namespace fs = std::filesystem;

namespace {

// The path behind all links, also if there is nothing yet.
fs::path behind_links(fs::path path) {
  constexpr int kMostLinks = 40;  // as Linux
  std::error_code error;
  for (int links = 0; fs::is_symlink(path, error); ++links) {
    if (links == kMostLinks)
      throw fs::filesystem_error("", path,
                                 std::make_error_code(std::errc::too_many_symbolic_link_levels));
    path = path.parent_path() / fs::read_symlink(path);
  }
  return path;
}

void make_folder(const fs::path& folder) {
  std::error_code error;
  if (!folder.empty()) fs::create_directories(folder, error);
  if (error)
    throw IoError(fmt::format("cannot make the folder {}: {}", folder.string(), error.message()));
}

// Waits until the names of the files in a folder are on the disk. Some file systems cannot do it.
void sync_folder(const fs::path& folder) {
  const Descriptor opened = open_file(folder, O_RDONLY | O_DIRECTORY);
  if (opened.number() >= 0) ::fsync(opened.number());
}

}  // namespace

void write_aside(const fs::path& path, const std::function<void(const fs::path&)>& write,
                 Durability durability) {
  try {
    const fs::file_status status = fs::status(path);
    if (fs::is_directory(status))
      throw IoError(fmt::format("cannot write {}: it is a folder", path.string()));
    if (fs::exists(status) && !fs::is_regular_file(status)) return write(path);
    const fs::path target = behind_links(path);
    const fs::path folder = target.has_parent_path() ? target.parent_path() : ".";
    make_folder(folder);
    const bool synced = durability == Durability::synced;
    if (synced) remove_stale_temporaries(folder);
    TemporaryFile aside(folder, path.extension());
    write(aside.path());
    if (synced) aside.sync();
    aside.rename_to(target);
    if (synced) sync_folder(folder);
  } catch (const std::system_error& e) {
    throw IoError(fmt::format("cannot write {}: {}", path.string(), e.code().message()));
  }
}

void write_text_file(const fs::path& path, std::string_view text) {
  write_aside(path, [&](const fs::path& aside) {
    std::ofstream out(aside, std::ios::binary);
    out.write(text.data(), static_cast<std::streamsize>(text.size()));
    out.close();
    if (!out)
      throw IoError(fmt::format("cannot write {}: {}", path.string(), std::strerror(errno)));
  });
}

std::string read_file(const fs::path& path) {
  std::error_code error;
  if (fs::is_directory(path, error))
    throw IoError(fmt::format("{} is a folder; name a file", path.string()));
  std::ifstream in(path, std::ios::binary);
  if (!in) throw IoError(fmt::format("cannot read {}: {}", path.string(), std::strerror(errno)));
  std::string bytes;
  // Reads the file at once if its size is known. Pipes have no size.
  const auto size = fs::file_size(path, error);
  if (!error) {
    bytes.resize(size);
    in.read(bytes.data(), static_cast<std::streamsize>(size));
    bytes.resize(static_cast<std::size_t>(in.gcount()));
  }
  bytes.append(std::istreambuf_iterator<char>(in), {});
  if (in.bad())
    throw IoError(fmt::format("cannot read {}: {}", path.string(), std::strerror(errno)));
  return bytes;
}

std::string content_hash(std::string_view bytes) {
  return fmt::format("{:016x}", XXH3_64bits(bytes.data(), bytes.size()));
}

}  // namespace springlod::inline base
