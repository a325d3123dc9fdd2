#include "sweep/work.hpp"

#include <chrono>
#include <condition_variable>
#include <exception>
#include <filesystem>
#include <fstream>
#include <mutex>
#include <optional>
#include <thread>

#include <fcntl.h>
#include <sys/stat.h>

#include "base/error.hpp"
#include "base/message.hpp"
#include "sweep/work_lines.hpp"

namespace springlod::sweep {

namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

/// Renews the time of a file again and again, while it lives: a sign of life for other machines.
class Heart {
 public:
  explicit Heart(fs::path file) : file_(std::move(file)), thread_([this] { beat(); }) {}
  ~Heart() {
    {
      const std::lock_guard lock(mutex_);
      ended_ = true;
    }
    changed_.notify_one();
    thread_.join();
  }
  Heart(const Heart&) = delete;
  Heart& operator=(const Heart&) = delete;

 private:
  void beat() {
    std::unique_lock lock(mutex_);
    // Without a time, a file server takes its own: the clock of this host may differ.
    while (!changed_.wait_for(lock, std::chrono::duration<double>(kBeat), [&] { return ended_; }))
      ::utimensat(AT_FDCWD, file_.c_str(), nullptr, 0);
  }

  fs::path file_;
  std::mutex mutex_;
  std::condition_variable changed_;
  bool ended_ = false;
  std::thread thread_;  // last: it uses the others
};

// Linux keeps the largest memory of a process until it is reset; see proc(5).
void forget_largest_memory() {
  std::ofstream("/proc/self/clear_refs") << "5";
}

std::uint64_t largest_memory() {
  std::ifstream status("/proc/self/status");
  std::string word;
  std::uint64_t kilobytes = 0;
  while (status >> word)
    if (word == "VmHWM:") status >> kilobytes;
  constexpr std::uint64_t kKilobyte = 1024;
  return kilobytes * kKilobyte;
}

UnitResult result_of(std::uint64_t unit, const WorkLabels& labels, const Runner& runner,
                     const UnitFunction& run) {
  UnitResult result{.unit = unit,
                    .version = labels.version,
                    .target = labels.target,
                    .blas = labels.blas,
                    .host = runner.host,
                    .log = labels.log};
  forget_largest_memory();
  const Clock::time_point begun = Clock::now();
  try {
    result.rows = run(unit);
  } catch (const InterruptedError&) {
    throw;
  } catch (const std::exception& error) {
    result.failure = printable(error.what());
    if (result.failure.empty()) result.failure = "unknown";
  }
  result.seconds = std::chrono::duration<double>(Clock::now() - begun).count();
  result.memory = largest_memory();
  return result;
}

/// Runs and keeps a unit whose `number`-th try has begun.
Report::Kind run_unit(const UnitFiles& files, const WorkLabels& labels, const Runner& runner,
                      const UnitFunction& run, std::uint64_t unit, int number) {
  try {
    const Heart heart(files.try_path(unit, number));
    const UnitResult result = result_of(unit, labels, runner, run);
    files.finish(result);
    return result.failure.empty() ? Report::Kind::done : Report::Kind::failed;
  } catch (...) {  // the user stops it, or the disk is full
    files.give_up(unit, number);
    throw;
  }
}

/// Runs the units of orders until there are no more.
void serve_orders(const UnitFiles& files, const WorkLabels& labels, const UnitFunction& run,
                  int socket) {
  const Runner runner = this_runner(labels.log);
  Lines lines(socket);
  using Kind = Report::Kind;
  if (!send_line(socket, line_of(Report{Kind::ready}))) return;
  while (const auto line = lines.next()) {
    const std::optional<Order> order = order_of(*line);
    if (!order) throw InputError("not an order of a sweep: " + *line);
    for (std::uint64_t unit = order->first; unit < order->end; ++unit) {
      const std::optional<int> number = files.begin(unit, runner);
      if (!number) continue;
      // Nobody waits for the rest if the other process has ended.
      if (!send_line(socket, line_of(Report{Kind::begun, unit, *number}))) {
        files.give_up(unit, *number);
        return;
      }
      const Kind kind = run_unit(files, labels, runner, run, unit, *number);
      if (!send_line(socket, line_of(Report{kind, unit, *number}))) return;
    }
    if (!send_line(socket, line_of(Report{Kind::ready}))) return;
  }
}

}  // namespace

void serve_units(const UnitFiles& files, const WorkLabels& labels, const UnitFunction& run,
                 int socket) {
  try {
    serve_orders(files, labels, run, socket);
  } catch (const std::exception& error) {
    send_line(socket, line_of_error(error.what()));
    throw;
  }
}

}  // namespace springlod::sweep
