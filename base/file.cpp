#include "base/file.hpp"

#include <cerrno>
#include <cstring>
#include <fstream>
#include <iterator>
#include <system_error>

#include <fmt/format.h>
#include <unistd.h>
#include <xxhash.h>

#include "base/error.hpp"

namespace springlod::inline base {

namespace fs = std::filesystem;

void write_aside(const fs::path& path, const std::function<void(const fs::path&)>& write) {
  std::error_code error;
  if (path.has_parent_path()) fs::create_directories(path.parent_path(), error);
  if (error)
    throw IoError(
        fmt::format("cannot make the folder {}: {}", path.parent_path().string(), error.message()));
  // The extension is kept: some writers choose the format by it.
  const fs::path aside = path.parent_path() / fmt::format(".{}.{}{}", path.stem().string(),
                                                          getpid(), path.extension().string());
  try {
    write(aside);
    fs::rename(aside, path);
  } catch (const fs::filesystem_error& e) {
    fs::remove(aside, error);
    throw IoError(fmt::format("cannot write {}: {}", path.string(), e.code().message()));
  } catch (...) {
    fs::remove(aside, error);
    throw;
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
