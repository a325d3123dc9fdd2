#pragma once

#include <atomic>
#include <chrono>
#include <cstdint>
#include <mutex>
#include <stop_token>
#include <string>
#include <string_view>
#include <thread>
#include <vector>

#include "base/progress.hpp"
#include "scripting/engine/flag_words.hpp"

namespace springlod::scripting {

enum class Verbosity { quiet, normal, verbose };

/// Writes messages and the progress of long tasks to stderr (stdout carries results). On a
/// terminal, progress is a bar with rate and remaining time, redrawn in place, also while a task
/// reports nothing; otherwise, a line at intervals. If verbose, each detail is a line. `advance`
/// throws InterruptedError after Ctrl-C.
class Console : public Progress {
 public:
  explicit Console(Verbosity verbosity);

  /// Prints a message of the program, made `printable`; not if quiet.
  void say(std::string_view text) override;
  /// Prints the text of a script as it is; not if quiet.
  void print(std::string_view text);
  /// How `say` names options.
  FlagWords& flag_words() { return flag_words_; }
  bool verbose() const { return verbosity_ == Verbosity::verbose; }

  void begin(std::string_view task, std::uint64_t total) override;
  void advance(std::uint64_t count) override;
  void end() override;
  void detail(std::string_view text) override;

 private:
  using Clock = std::chrono::steady_clock;
  struct Running {
    std::string name;
    std::uint64_t total = 0;
    std::uint64_t done = 0;
    Clock::time_point start;
    Clock::time_point next_report;
    bool reported = false;
    std::string detail;
  };

  void report(Running& running, Clock::time_point now, bool last);
  void clear_bar();
  void redraw_until(const std::stop_token& stop);

  Verbosity verbosity_;
  bool terminal_;
  bool colour_;
  std::mutex mutex_;
  std::vector<Running> running_;           // nested tasks: the innermost is shown
  std::atomic<std::uint64_t> pending_{0};  // counts not yet added to running_.back()
  std::atomic<Clock::rep> next_check_{0};
  bool bar_shown_ = false;
  std::size_t redraws_ = 0;  // the mark in front of the bar turns with each
  FlagWords flag_words_;
  // Redraws the line of work that reports nothing, such as a factorization. It lives while a task
  // runs, and ends before the members that it uses.
  std::jthread sign_of_life_;
};

/// Columns of the terminal that shows stderr; 0 if it shows on none.
std::size_t terminal_columns();

/// One line of progress: "voxelize  [=====>    ]  52 %  1300/s  0:03 left".
std::string progress_line(std::string_view task, std::uint64_t done, std::uint64_t total,
                          double seconds, bool bar);

/// The same with a detail behind it, in at most `columns`: a longer line would wrap, and could not
/// be redrawn in place. Drops the bar first, then the end of the detail.
std::string fitted_progress_line(std::string_view task, std::uint64_t done, std::uint64_t total,
                                 double seconds, std::string_view detail, std::size_t columns);

}  // namespace springlod::scripting
