#include "scripting/engine/history.hpp"

#include <algorithm>
#include <fstream>
#include <iterator>
#include <string_view>
#include <system_error>
#include <utility>

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

namespace springlod::scripting {

namespace fs = std::filesystem;

namespace {

constexpr int kChunks = 2000;
// The file is shortened to kChunks when it has more lines.
constexpr std::ptrdiff_t kFileLines = 2L * kChunks;
// Longer chunks, such as pasted files, stay in memory [bytes].
constexpr std::size_t kLongestChunk = 16UL * 1024;
// The first line of a history file of libedit, which reads and shortens it.
constexpr std::string_view kFirstLine = "_HiStOrY_V2_\n";

// One line of the file: what could end it or is special to libedit's strunvis is an octal escape.
std::string encoded(const std::string& chunk) {
  std::string line;
  for (const char c : chunk) {
    const auto byte = static_cast<unsigned char>(c);
    if (byte > ' ' && byte < 0x7F && c != '\\')
      line += c;
    else
      line += fmt::format("\\{:03o}", byte);
  }
  return line + "\n";
}

std::ptrdiff_t line_count(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  return std::count(std::istreambuf_iterator<char>(in), {}, '\n');
}

}  // namespace

PromptHistory::PromptHistory(fs::path file) : file_(std::move(file)), history_(history_init()) {
  HistEvent event;
  history(history_, &event, H_SETSIZE, kChunks);
  history(history_, &event, H_SETUNIQUE, 1);
  load();
}

PromptHistory::~PromptHistory() {
  history_end(history_);
}

void PromptHistory::load() {
  std::error_code error;
  if (file_.empty() || !fs::is_regular_file(file_, error) || fs::file_size(file_, error) == 0)
    return;
  HistEvent event;
  if (history(history_, &event, H_LOAD, file_.c_str()) < 0) {
    fs::rename(file_, file_.string() + ".damaged", error);
    return;
  }
  if (line_count(file_) <= kFileLines) return;
  // Renaming is atomic: a process that ends here leaves the long file or the short one.
  const std::string shorter = fmt::format("{}.{}", file_.string(), getpid());
  if (history(history_, &event, H_SAVE, shorter.c_str()) >= 0)
    fs::rename(shorter, file_, error);
  else
    fs::remove(shorter, error);
}

void PromptHistory::add(const std::string& chunk) {
  if (chunk == last_) return;
  last_ = chunk;
  HistEvent event;
  history(history_, &event, H_ENTER, chunk.c_str());
  if (!file_.empty() && chunk.size() <= kLongestChunk) append(chunk);
}

void PromptHistory::append(const std::string& chunk) const {
  std::error_code error;
  fs::create_directories(file_.parent_path(), error);
  const int file = open(file_.c_str(), O_RDWR | O_APPEND | O_CREAT | O_CLOEXEC, S_IRUSR | S_IWUSR);
  if (file < 0) return;
  flock(file, LOCK_EX);  // until it is closed: of two new prompts, one writes the first line
  std::string text = encoded(chunk);
  const off_t size = lseek(file, 0, SEEK_END);
  char last = '\n';
  if (size == 0)
    text.insert(0, kFirstLine);
  else if (size > 0 && pread(file, &last, 1, size - 1) == 1 && last != '\n')
    text.insert(text.begin(), '\n');  // the rest of a write that failed, as on a full disk
  [[maybe_unused]] const ssize_t written = write(file, text.data(), text.size());
  close(file);
}

}  // namespace springlod::scripting
