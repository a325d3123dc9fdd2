#include "base/folder_claim.hpp"

#include <array>
#include <cerrno>
#include <cstring>
#include <sstream>
#include <string_view>
#include <system_error>
#include <utility>

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include "base/error.hpp"
#include "base/file_lock.hpp"

namespace springlod::inline base {

namespace fs = std::filesystem;

namespace {

constexpr const char* kMark = ".springlod-run";
constexpr mode_t kMode = 0666;  // before the umask
constexpr std::string_view kUnfinished = "unfinished";
constexpr std::string_view kFinished = "finished";

/// The content of the mark: one line each. Empty if the mark is new, or was cut by a kill.
struct Mark {
  std::string command;
  std::string state;
  std::string process;
};

Mark read_mark(const Descriptor& file) {
  std::array<char, 1000> bytes{};
  const ssize_t count = ::pread(file.number(), bytes.data(), bytes.size(), 0);
  std::istringstream lines(
      std::string(bytes.data(), count > 0 ? static_cast<std::size_t>(count) : 0));
  Mark mark;
  std::getline(lines, mark.command);
  std::getline(lines, mark.state);
  std::getline(lines, mark.process);
  return mark;
}

[[noreturn]] void fail(const fs::path& folder) {
  throw IoError(fmt::format("cannot write to the folder {}: {}; use another one", folder.string(),
                            std::strerror(errno)));
}

void write_mark(const Descriptor& file, const fs::path& folder, const std::string& command,
                std::string_view state) {
  const std::string text = fmt::format("{}\n{}\n{}\n", command, state, ::getpid());
  // The new lines are written over the old ones, so that a kill leaves no empty mark.
  if (::pwrite(file.number(), text.data(), text.size(), 0) != static_cast<ssize_t>(text.size()) ||
      ::ftruncate(file.number(), static_cast<off_t>(text.size())) != 0)
    fail(folder);
}

}  // namespace

FolderClaim::FolderClaim(fs::path folder, std::string command)
    : folder_(std::move(folder)), command_(std::move(command)) {
  std::error_code error;
  made_ = fs::create_directories(folder_, error);
  if (error)
    throw IoError(fmt::format("cannot make the folder {}: {}", folder_.string(), error.message()));
  take();
  check_former();
  write_mark(mark_, folder_, command_, kUnfinished);
}

// Opens the mark and locks it. The process that held the lock may have removed the mark.
void FolderClaim::take() {
  const fs::path path = folder_ / kMark;
  struct stat opened {
  }, named{};
  do {
    mark_ = open_file(path, O_RDWR | O_CREAT, kMode);
    if (mark_.number() < 0) fail(folder_);
    if (lock_file(mark_, LOCK_EX | LOCK_NB) == EWOULDBLOCK) {
      const Mark mark = read_mark(mark_);
      throw InputError(
          fmt::format("the folder {} is in use by springlod {} (process {}); wait until it has "
                      "finished, or use another folder",
                      folder_.string(), mark.command, mark.process));
    }
    if (::fstat(mark_.number(), &opened) != 0) fail(folder_);
  } while (::stat(path.c_str(), &named) != 0 || opened.st_ino != named.st_ino);
}

void FolderClaim::check_former() {
  const Mark former = read_mark(mark_);
  if (former.command.empty() || is_empty()) return;
  continues_ = former.state != kFinished;
  if (former.command == command_) return;
  throw InputError(fmt::format(
      "the folder {} holds {} of springlod {}; use another folder for springlod {}, or remove this "
      "one",
      folder_.string(), continues_ ? "an unfinished run" : "the results", former.command,
      command_));
}

bool FolderClaim::is_empty() const {
  std::error_code error;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder_, error))
    if (entry.path().filename() != kMark) return false;
  return true;
}

void FolderClaim::finish() {
  write_mark(mark_, folder_, command_, kFinished);
}

FolderClaim::~FolderClaim() {
  if (!is_empty()) return;
  ::unlink((folder_ / kMark).c_str());
  if (made_ || continues_) ::rmdir(folder_.c_str());
}

}  // namespace springlod::inline base
