#include "scripting/engine/console.hpp"

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <condition_variable>
#include <csignal>
#include <cstdlib>

#include <fmt/format.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include "base/error.hpp"
#include "base/message.hpp"
#include "scripting/engine/interrupt.hpp"

namespace springlod::scripting {

namespace {

using namespace std::chrono_literals;

// Shorter tasks show no bar.
constexpr auto kSilentFor = 500ms;
// Interval between two updates of the bar.
constexpr auto kRedraw = 100ms;
// Longest time without a redraw, of which half passes between two looks.
constexpr auto kSignOfLife = 1000ms;
// In front of the bar; the next one at each redraw.
constexpr std::string_view kMarks = "|/-\\";
// Interval between two progress lines in a log file.
constexpr auto kLogLine = 10s;
constexpr int kBarWidth = 24;
// Of a terminal that does not state its size.
constexpr std::size_t kUsualColumns = 80;

std::string clock_text(double seconds) {
  const auto whole = static_cast<long long>(std::ceil(std::min(seconds, 359999.0)));
  if (whole >= 3600)
    return fmt::format("{}:{:02}:{:02}", whole / 3600, whole / 60 % 60, whole % 60);
  return fmt::format("{}:{:02}", whole / 60, whole % 60);
}

std::string rate_text(double rate) {
  if (rate >= 1e6) return fmt::format("{:.1f} M/s", rate / 1e6);
  if (rate >= 1e3) return fmt::format("{:.1f} k/s", rate / 1e3);
  return fmt::format("{:.1f} /s", rate);
}

// Ignores failed writes, because lost messages must not stop the computation. Retries a write that
// a signal interrupted (EINTR).
void put(std::string_view text) {
  while (!text.empty()) {
    const ssize_t count = write(STDERR_FILENO, text.data(), text.size());
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) return;
    text.remove_prefix(static_cast<std::size_t>(count));
  }
}

// An empty variable counts as not set (no-color.org).
bool is_set(const char* variable) {
  const char* value = std::getenv(variable);
  return value != nullptr && *value != 0;
}

// The first `columns` characters of UTF-8 text.
std::string cut(const std::string& text, std::size_t columns) {
  std::size_t shown = 0;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const bool continues = (static_cast<unsigned char>(text[i]) & 0xC0U) == 0x80;
    if (!continues && shown++ == columns) return text.substr(0, i);
  }
  return text;
}

}  // namespace

std::size_t terminal_columns() {
  winsize size{};
  return ioctl(STDERR_FILENO, TIOCGWINSZ, &size) == 0 ? size.ws_col : 0;
}

std::string progress_line(std::string_view task, std::uint64_t done, std::uint64_t total,
                          double seconds, bool bar) {
  const double rate = seconds > 0 ? static_cast<double>(done) / seconds : 0;
  std::string line = fmt::format("{:<12}", task);
  if (total == 0)  // of unknown length
    return done == 0 ? line : line + fmt::format("  {}  {}", done, rate_text(rate));
  const double part = std::min(1.0, static_cast<double>(done) / static_cast<double>(total));
  if (bar) {
    const int filled = static_cast<int>(part * kBarWidth);
    line += fmt::format("  [{}{}]", std::string(filled, '='), std::string(kBarWidth - filled, ' '));
  }
  line += fmt::format("  {:3.0f} %", 100 * part);
  if (done == 0) return line;
  line += fmt::format("  {}", rate_text(rate));
  if (done >= total) return line + fmt::format("  took {}", clock_text(seconds));
  if (rate > 0)
    line += fmt::format("  {} left", clock_text(static_cast<double>(total - done) / rate));
  return line;
}

std::string fitted_progress_line(std::string_view task, std::uint64_t done, std::uint64_t total,
                                 double seconds, std::string_view detail, std::size_t columns) {
  const auto line = [&](bool bar) {
    std::string text = progress_line(task, done, total, seconds, bar);
    if (!detail.empty()) text += fmt::format("  {}", detail);
    return text;
  };
  const std::string full = line(true);
  if (cut(full, columns) == full) return full;
  const std::string text = cut(line(false), columns);
  // Without part of a number: fields have two spaces between them.
  const bool whole = text.size() >= progress_line(task, done, total, seconds, false).size();
  return whole ? text : text.substr(0, text.rfind("  "));
}

Console::Console(Verbosity verbosity)
    : verbosity_(verbosity),
      terminal_(isatty(STDERR_FILENO) != 0),
      colour_(terminal_ && !is_set("NO_COLOR")) {}

void Console::say(std::string_view text) {
  print(flag_words_.in_flags(printable(text)));
}

void Console::print(std::string_view text) {
  if (verbosity_ == Verbosity::quiet) return;
  const std::lock_guard lock(mutex_);
  clear_bar();
  put(fmt::format("{}\n", text));
}

void Console::begin(std::string_view task, std::uint64_t total) {
  const std::lock_guard lock(mutex_);
  if (!running_.empty()) running_.back().done += pending_.exchange(0);
  pending_ = 0;
  const auto now = Clock::now();
  running_.push_back({std::string(task),
                      total,
                      0,
                      now,
                      now + (terminal_ ? Clock::duration(kSilentFor) : kLogLine),
                      false,
                      {}});
  next_check_ = 0;
  if (!terminal_ || verbosity_ == Verbosity::quiet || running_.size() > 1) return;
  sign_of_life_ = std::jthread([this](const std::stop_token& stop) { redraw_until(stop); });
}

void Console::redraw_until(const std::stop_token& stop) {
  sigset_t all;  // signals are for the thread that waits for keys
  sigfillset(&all);
  pthread_sigmask(SIG_BLOCK, &all, nullptr);
  std::condition_variable_any stopped;
  std::unique_lock until_stopped(mutex_);
  while (!stopped.wait_for(until_stopped, stop, kSignOfLife / 2, [] { return false; }) &&
         !stop.stop_requested()) {
    if (running_.empty()) continue;
    Running& running = running_.back();
    const auto time = Clock::now();
    running.done += pending_.exchange(0);
    // next_report is a kRedraw after the last one.
    if (time >= running.next_report + (kSignOfLife / 2 - kRedraw)) report(running, time, false);
  }
}

void Console::advance(std::uint64_t count) {
  if (interrupt_requested()) throw InterruptedError();
  pending_.fetch_add(count, std::memory_order_relaxed);
  const auto now = Clock::now();
  if (now.time_since_epoch().count() < next_check_.load(std::memory_order_relaxed)) return;
  next_check_ = (now + kRedraw).time_since_epoch().count();
  const std::lock_guard lock(mutex_);
  if (running_.empty()) return;
  Running& running = running_.back();
  running.done += pending_.exchange(0);
  if (now >= running.next_report) report(running, now, false);
}

void Console::end() {
  std::jthread finished;  // ends and is joined after the lock, for which it may wait
  const std::lock_guard lock(mutex_);
  if (running_.empty()) return;
  Running running = std::move(running_.back());
  running_.pop_back();
  running.done += pending_.exchange(0);
  if (running_.empty()) finished = std::move(sign_of_life_);
  if (terminal_) {
    // The line of an outer task stays, or takes the place of its own at once: cleared and drawn
    // again, it would flicker.
    const bool outer = bar_shown_ && !running_.empty() && running_.back().reported;
    if (!outer)
      clear_bar();
    else if (running.reported)
      report(running_.back(), Clock::now(), false);
  } else if (running.reported) {
    report(running, Clock::now(), true);
  }
}

void Console::detail(std::string_view text) {
  const std::lock_guard lock(mutex_);
  if (running_.empty()) return;
  running_.back().detail = text;
  if (!verbose()) return;
  clear_bar();
  put(fmt::format("{}\n", text));
}

void Console::report(Running& running, Clock::time_point now, bool last) {
  running.next_report = now + (terminal_ ? Clock::duration(kRedraw) : kLogLine);
  if (verbosity_ == Verbosity::quiet) return;
  running.reported = true;
  const double seconds = std::chrono::duration<double>(now - running.start).count();
  const std::string_view detail = last ? std::string_view() : running.detail;
  if (!terminal_) {
    const std::string line =
        progress_line(running.name, running.done, running.total, seconds, false);
    put(fmt::format("{}{}{}\n", line, detail.empty() ? "" : "  ", detail));
    return;
  }
  // A terminal may wrap when its last column is written, so that column stays empty.
  const std::size_t columns = terminal_columns();
  const char mark = kMarks[redraws_++ % kMarks.size()];
  constexpr std::size_t kBeside = 3;  // the mark, a space, and the last column
  const std::string line =
      fitted_progress_line(running.name, running.done, running.total, seconds, detail,
                           std::max(columns > 0 ? columns : kUsualColumns, kBeside) - kBeside);
  // \033[K clears the rest of an earlier, longer line; \033[2m is dim, which NO_COLOR turns off.
  put(fmt::format("\r{}{} {}{}\033[K", colour_ ? "\033[2m" : "", mark, line,
                  colour_ ? "\033[0m" : ""));
  bar_shown_ = !last;
}

void Console::clear_bar() {
  if (!bar_shown_) return;
  put("\r\033[K");
  bar_shown_ = false;
}

}  // namespace springlod::scripting
