#include "base/temporary_file.hpp"

#include <cerrno>
#include <string>
#include <string_view>
#include <system_error>

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include "base/file_lock.hpp"

namespace springlod::inline base {

namespace fs = std::filesystem;

namespace {

// Hidden, and not a name that a user gives to a file.
constexpr std::string_view kPrefix = ".springlod-";
constexpr mode_t kMode = 0666;  // before the umask

[[noreturn]] void fail(int error) {
  throw std::system_error(error, std::generic_category());
}

// Another process may remove a file that was made, but not yet locked.
bool still_there(const Descriptor& file) {
  struct stat status {};
  return ::fstat(file.number(), &status) == 0 && status.st_nlink > 0;
}

bool is_at(const Descriptor& file, const fs::path& path) {
  struct stat ours {
  }, named{};
  return ::fstat(file.number(), &ours) == 0 && ::lstat(path.c_str(), &named) == 0 &&
         ours.st_dev == named.st_dev && ours.st_ino == named.st_ino;
}

bool is_temporary(const fs::path& path) {
  const std::string name = path.filename().string();
  if (!name.starts_with(kPrefix)) return false;
  const std::string_view numbers = std::string_view(name).substr(kPrefix.size());
  const std::size_t end = numbers.find_first_not_of("0123456789-");
  return !numbers.empty() && end != 0 && (end == std::string_view::npos || numbers[end] == '.');
}

}  // namespace

TemporaryFile::TemporaryFile(const fs::path& folder, const fs::path& extension) {
  for (int number = 0;; ++number) {
    const fs::path path =
        folder / fmt::format("{}{}-{}{}", kPrefix, ::getpid(), number, extension.string());
    Descriptor file = open_file(path, O_RDWR | O_CREAT | O_EXCL, kMode);
    if (file.number() < 0) {
      if (errno == EEXIST) continue;
      fail(errno);
    }
    lock_file(file, LOCK_EX);  // where there are no locks, nobody removes the file either
    if (!still_there(file)) continue;
    path_ = path;
    file_ = std::move(file);
    return;
  }
}

TemporaryFile::~TemporaryFile() {
  if (!path_.empty()) ::unlink(path_.c_str());
}

void TemporaryFile::sync() const {
  // EINVAL: a file system without it.
  if (::fsync(file_.number()) != 0 && errno != EINVAL) fail(errno);
}

void TemporaryFile::rename_to(const fs::path& target) {
  if (::rename(path_.c_str(), target.c_str()) != 0) fail(errno);
  path_.clear();
  file_.close();
}

void remove_stale_temporaries(const fs::path& folder) {
  std::error_code error;
  for (fs::directory_iterator entry(folder, error), end; !error && entry != end;
       entry.increment(error)) {
    const fs::path& path = entry->path();
    if (!is_temporary(path)) continue;
    const Descriptor file = open_file(path, O_RDONLY | O_NOFOLLOW | O_NONBLOCK);
    if (file.number() < 0 || lock_file(file, LOCK_EX | LOCK_NB) != 0) continue;
    // With the lock and under the same name, it is the file of a process that has ended: its name
    // does not pass to another file meanwhile.
    if (is_at(file, path)) ::unlink(path.c_str());
  }
}

}  // namespace springlod::inline base
