#include "sweep/unit_files.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <chrono>
#include <cstdlib>
#include <fstream>
#include <sstream>
#include <string_view>

#include <fcntl.h>
#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <unistd.h>

#include "base/descriptor.hpp"
#include "base/error.hpp"
#include "base/file.hpp"

namespace springlod::sweep {

namespace {

namespace fs = std::filesystem;
using nlohmann::ordered_json;

// Files of one folder: file systems get slow with very many.
constexpr std::uint64_t kUnitsOfFolder = 1000;

/// When a process of this host was started [ticks since the host was]; 0 if there is none.
std::uint64_t start_of_process(std::int64_t process) {
  std::ifstream file(fmt::format("/proc/{}/stat", process));
  std::string line;
  if (!std::getline(file, line)) return 0;
  // The name of the program, in parentheses, may hold anything; then come state and numbers.
  const std::size_t name_end = line.rfind(')');
  if (name_end == std::string::npos) return 0;
  std::istringstream fields(line.substr(name_end + 1));
  constexpr int kStartField = 20;  // counted from the state; see proc(5)
  std::string field;
  for (int i = 0; i < kStartField; ++i) fields >> field;
  if (field.empty() || line.find(") Z ", name_end) == name_end) return 0;
  return std::strtoull(field.c_str(), nullptr, 10);
}

std::string to_text(const Runner& runner) {
  return ordered_json{{"host", runner.host},       {"process", runner.process},
                      {"started", runner.started}, {"job", runner.job},
                      {"log", runner.log},         {"signal", runner.signal}}
             .dump() +
         "\n";
}

std::optional<Runner> runner_from(const std::string& text) {
  const ordered_json json = ordered_json::parse(text, nullptr, false);
  if (!json.is_object()) return std::nullopt;
  return Runner{json.value("host", ""),
                json.value("process", std::int64_t{0}),
                json.value("started", std::uint64_t{0}),
                json.value("job", ""),
                json.value("log", ""),
                json.value("signal", 0)};
}

/// Reads "0012345.try-2" and the like; nothing for other names.
struct NamedFile {
  std::uint64_t unit = 0;
  std::string_view rest;  ///< ".try-2"
};
std::optional<NamedFile> parse_name(std::string_view name) {
  NamedFile file;
  const auto [end, error] = std::from_chars(name.data(), name.data() + name.size(), file.unit);
  if (error != std::errc{}) return std::nullopt;
  file.rest = name.substr(static_cast<std::size_t>(end - name.data()));
  return file;
}

constexpr std::string_view kResult = ".json", kFailure = ".failed.json", kTry = ".try-";

void note(UnitNotes& notes, std::string_view rest) {
  if (rest == kResult) notes.done = true;
  if (rest == kFailure) notes.failed = true;
  if (rest.starts_with(kTry) && rest.size() == kTry.size() + 1)
    notes.tries = std::max(notes.tries, rest.back() - '0');
}

}  // namespace

std::string host_name() {
  std::array<char, 256> name{};
  return ::gethostname(name.data(), name.size() - 1) == 0 ? name.data() : "unknown";
}

Runner this_runner(std::string log) {
  const char* job = std::getenv("SLURM_JOB_ID");
  const auto process = static_cast<std::int64_t>(::getpid());
  return {.host = host_name(),
          .process = process,
          .started = start_of_process(process),
          .job = job == nullptr ? "" : job,
          .log = std::move(log)};
}

fs::path UnitFiles::stem(std::uint64_t unit) const {
  return folder_ / "results" / fmt::format("{:04}", unit / kUnitsOfFolder) /
         fmt::format("{:07}", unit);
}

fs::path UnitFiles::result_path(std::uint64_t unit) const {
  return stem(unit).concat(kResult);
}

fs::path UnitFiles::failure_path(std::uint64_t unit) const {
  return stem(unit).concat(kFailure);
}

fs::path UnitFiles::try_path(std::uint64_t unit, int number) const {
  return stem(unit).concat(fmt::format("{}{}", kTry, number));
}

std::vector<UnitNotes> UnitFiles::list(std::uint64_t first, std::uint64_t end) const {
  std::vector<UnitNotes> all(end - first);
  for (std::uint64_t unit = first; unit < end; unit += kUnitsOfFolder - unit % kUnitsOfFolder) {
    std::error_code missing;
    for (const fs::directory_entry& entry :
         fs::directory_iterator(stem(unit).parent_path(), missing)) {
      const std::string name = entry.path().filename().string();
      const auto file = parse_name(name);
      if (file && file->unit >= first && file->unit < end)
        note(all[file->unit - first], file->rest);
    }
  }
  return all;
}

UnitNotes UnitFiles::notes(std::uint64_t unit) const {
  std::error_code ignored;
  UnitNotes notes;
  notes.done = fs::exists(result_path(unit), ignored);
  notes.failed = !notes.done && fs::exists(failure_path(unit), ignored);
  for (int number = 1; number <= kMostTries; ++number)
    if (fs::exists(try_path(unit, number), ignored)) notes.tries = number;
  return notes;
}

UnitState UnitFiles::state(std::uint64_t unit, const UnitNotes& notes) const {
  if (notes.done) return UnitState::done;
  if (notes.failed) return UnitState::failed;
  if (notes.tries == 0) return UnitState::missing;
  if (is_alive(unit, notes.tries)) return UnitState::running;
  return notes.tries < kMostTries ? UnitState::waiting : UnitState::lost;
}

std::optional<int> UnitFiles::begin(std::uint64_t unit, const Runner& runner) const {
  const UnitNotes before = notes(unit);
  if (!needs_run(state(unit, before))) return std::nullopt;
  const int number = before.tries + 1;
  const fs::path path = try_path(unit, number);
  std::error_code error;
  fs::create_directories(path.parent_path(), error);
  constexpr mode_t kMode = 0666;
  const Descriptor file = open_file(path, O_WRONLY | O_CREAT | O_EXCL, kMode);
  if (file.number() < 0) {
    if (errno == EEXIST) return std::nullopt;
    throw IoError(fmt::format("cannot write {}: {}", path.string(), std::strerror(errno)));
  }
  const std::string text = to_text(runner);
  if (::write(file.number(), text.data(), text.size()) != static_cast<ssize_t>(text.size())) {
    const int cause = errno;
    fs::remove(path, error);
    throw IoError(fmt::format("cannot write {}: {}", path.string(), std::strerror(cause)));
  }
  // Another process may have finished the unit between the look above and this try.
  if (notes(unit).done) {
    remove_tries(unit);
    return std::nullopt;
  }
  return number;
}

void UnitFiles::finish(const UnitResult& result) const {
  write_text_file(result.failure.empty() ? result_path(result.unit) : failure_path(result.unit),
                  sweep::to_text(result));
  remove_tries(result.unit);
}

void UnitFiles::give_up(std::uint64_t unit, int number) const {
  std::error_code ignored;
  fs::remove(try_path(unit, number), ignored);
}

void UnitFiles::note_signal(std::uint64_t unit, int number, int signal) const {
  std::optional<Runner> runner = read_try(unit, number);
  if (!runner) return;
  runner->signal = signal;
  write_text_file(try_path(unit, number), to_text(*runner));
}

void UnitFiles::forget(std::uint64_t unit) const {
  std::error_code ignored;
  fs::remove(failure_path(unit), ignored);
  remove_tries(unit);
}

void UnitFiles::remove_tries(std::uint64_t unit) const {
  std::error_code ignored;
  for (int number = 1; number <= kMostTries; ++number) fs::remove(try_path(unit, number), ignored);
}

UnitResult UnitFiles::read_result(std::uint64_t unit) const {
  return result_from_text(read_file(result_path(unit)));
}

UnitResult UnitFiles::read_failure(std::uint64_t unit) const {
  return result_from_text(read_file(failure_path(unit)));
}

std::optional<Runner> UnitFiles::read_try(std::uint64_t unit, int number) const {
  const fs::path path = try_path(unit, number);
  std::error_code ignored;
  if (!fs::exists(path, ignored)) return std::nullopt;
  return runner_from(read_file(path));
}

bool UnitFiles::is_alive(std::uint64_t unit, int number) const {
  const fs::path path = try_path(unit, number);
  std::error_code error;
  const auto beat = fs::last_write_time(path, error);
  if (error) return false;
  const std::optional<Runner> runner = read_try(unit, number);
  static const std::string here = host_name();
  if (runner && runner->host == here)
    return runner->signal == 0 && runner->started != 0 &&
           start_of_process(runner->process) == runner->started;
  if (runner && runner->signal != 0) return false;
  return std::chrono::duration<double>(time_of_folder() - beat).count() < kSilence;
}

// The time of the file system, whose clock need not be that of this host.
fs::file_time_type UnitFiles::time_of_folder() const {
  const fs::path path = folder_ / ".clock";
  write_aside(
      path, [](const fs::path&) {}, Durability::unsynced);
  return fs::last_write_time(path);
}

}  // namespace springlod::sweep
