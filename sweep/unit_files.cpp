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
  return ordered_json{{"host", runner.host},       {"system", runner.system},
                      {"process", runner.process}, {"started", runner.started},
                      {"job", runner.job},         {"log", runner.log},
                      {"signal", runner.signal}}
             .dump() +
         "\n";
}

/// Nothing for damaged text: the process is then judged by its signs of life alone.
std::optional<Runner> runner_from(const std::string& text) {
  try {
    const ordered_json json = ordered_json::parse(text);
    return Runner{json.at("host"), json.at("system"), json.at("process"), json.at("started"),
                  json.at("job"),  json.at("log"),    json.at("signal")};
  } catch (const nlohmann::json::exception&) {
    return std::nullopt;
  }
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

InputError damaged(const fs::path& path) {
  return InputError(fmt::format("{} is damaged: remove it and resume the sweep", path.string()));
}

UnitResult read(std::uint64_t unit, const fs::path& path) {
  const std::string text = read_file(path);
  try {
    UnitResult result = result_from_text(text);
    if (result.unit == unit) return result;
  } catch (const InputError&) {
    // named below
  }
  throw damaged(path);
}

constexpr std::string_view kResult = ".json", kFailure = ".failed.json", kTry = ".try-";

}  // namespace

/// The files of one unit.
struct UnitFiles::Found {
  bool result = false;
  bool failure = false;
  int tries = 0;  ///< the highest number of a try; 0: none

  void add(std::string_view rest) {
    if (rest == kResult) result = true;
    if (rest == kFailure) failure = true;
    if (rest.starts_with(kTry) && rest.size() == kTry.size() + 1)
      tries = std::max(tries, rest.back() - '0');
  }
};

/// The time of the file system, whose clock need not be that of this host. It is looked up once,
/// when it is first needed.
class UnitFiles::Clock {
 public:
  explicit Clock(const fs::path& folder) : file_(folder / ".clock") {}
  fs::file_time_type now() {
    if (!now_) now_ = look();
    return *now_;
  }

 private:
  fs::file_time_type look() const {
    try {
      write_aside(
          file_, [](const fs::path&) {}, Durability::unsynced);
      return fs::last_write_time(file_);
    } catch (const IoError&) {  // who may only read the folder may still ask how far it is
      return fs::file_time_type::clock::now();
    }
  }

  fs::path file_;
  std::optional<fs::file_time_type> now_;
};

std::string host_name() {
  std::array<char, 256> name{};
  return ::gethostname(name.data(), name.size() - 1) == 0 ? name.data() : "unknown";
}

std::string this_system() {
  std::ifstream file("/proc/sys/kernel/random/boot_id");
  std::string start;
  file >> start;
  std::error_code error;
  return start + " " + fs::read_symlink("/proc/self/ns/pid", error).string();
}

Runner this_runner(std::string log) {
  const char* job = std::getenv("SLURM_JOB_ID");
  const auto process = static_cast<std::int64_t>(::getpid());
  return {.host = host_name(),
          .system = this_system(),
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
  std::vector<Found> found(end - first);
  for (std::uint64_t unit = first; unit < end; unit += kUnitsOfFolder - unit % kUnitsOfFolder) {
    std::error_code missing;
    for (const fs::directory_entry& entry :
         fs::directory_iterator(stem(unit).parent_path(), missing)) {
      const std::string name = entry.path().filename().string();
      const auto file = parse_name(name);
      if (file && file->unit >= first && file->unit < end)
        found[file->unit - first].add(file->rest);
    }
  }
  Clock clock(folder_);
  std::vector<UnitNotes> notes;
  for (std::uint64_t unit = first; unit < end; ++unit)
    notes.push_back(notes_of(unit, found[unit - first], clock));
  return notes;
}

std::vector<UnitNotes> UnitFiles::list(const std::vector<std::uint64_t>& units) const {
  Clock clock(folder_);
  std::vector<UnitNotes> notes;
  for (const std::uint64_t unit : units) notes.push_back(notes_of(unit, find(unit), clock));
  return notes;
}

UnitFiles::Found UnitFiles::find(std::uint64_t unit) const {
  std::error_code ignored;
  Found found{.result = fs::exists(result_path(unit), ignored),
              .failure = fs::exists(failure_path(unit), ignored)};
  for (int number = 1; number <= kMostTries; ++number)
    if (fs::exists(try_path(unit, number), ignored)) found.tries = number;
  return found;
}

UnitNotes UnitFiles::notes_of(std::uint64_t unit, const Found& found, Clock& clock) const {
  const auto state = [&] {
    if (found.result) return UnitState::done;
    if (found.failure) return UnitState::failed;
    if (found.tries == 0) return UnitState::missing;
    if (is_alive(unit, found.tries, clock)) return UnitState::running;
    return found.tries < kMostTries ? UnitState::waiting : UnitState::lost;
  };
  return {state(), found.tries};
}

std::optional<int> UnitFiles::begin(std::uint64_t unit, const Runner& runner) const {
  const UnitNotes before = notes(unit);
  if (!needs_run(before.state)) return std::nullopt;
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
  if (find(unit).result) {
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
  const fs::path failure = failure_path(unit);
  std::error_code error;
  fs::remove(failure, error);
  if (error) throw IoError(fmt::format("cannot remove {}: {}", failure.string(), error.message()));
  remove_tries(unit);
}

void UnitFiles::remove_tries(std::uint64_t unit) const {
  std::error_code ignored;
  for (int number = 1; number <= kMostTries; ++number) fs::remove(try_path(unit, number), ignored);
}

UnitResult UnitFiles::read_result(std::uint64_t unit, std::size_t columns) const {
  const fs::path path = result_path(unit);
  UnitResult result = read(unit, path);
  const auto fits = [&](const Row& row) { return row.size() == columns; };
  if (!result.failure.empty() || !std::all_of(result.rows.begin(), result.rows.end(), fits))
    throw damaged(path);
  return result;
}

UnitResult UnitFiles::read_failure(std::uint64_t unit) const {
  const fs::path path = failure_path(unit);
  UnitResult result = read(unit, path);
  if (result.failure.empty()) throw damaged(path);
  return result;
}

std::optional<Runner> UnitFiles::read_try(std::uint64_t unit, int number) const {
  const fs::path path = try_path(unit, number);
  std::error_code ignored;
  if (!fs::exists(path, ignored)) return std::nullopt;
  return runner_from(read_file(path));
}

bool UnitFiles::is_alive(std::uint64_t unit, int number, Clock& clock) const {
  const fs::path path = try_path(unit, number);
  std::error_code error;
  const auto beat = fs::last_write_time(path, error);
  if (error) return false;
  const std::optional<Runner> runner = read_try(unit, number);
  static const std::string here = this_system();
  if (runner && runner->system == here)
    return runner->signal == 0 && runner->started != 0 &&
           start_of_process(runner->process) == runner->started;
  if (runner && runner->signal != 0) return false;
  return std::chrono::duration<double>(clock.now() - beat).count() < kSilence;
}

}  // namespace springlod::sweep
