#pragma once

#include <cstdint>
#include <string_view>

namespace springlod::inline base {

/// Receives the progress of long work. The default implementation of every member does nothing.
/// `advance` is called from several threads at once.
class Progress {
 public:
  virtual ~Progress() = default;
  virtual void begin(std::string_view /*task*/, std::uint64_t /*total*/) {}
  /// Reports `count` finished items. May throw InterruptedError to stop the work.
  virtual void advance(std::uint64_t /*count*/) {}
  virtual void end() {}
  /// Current state of the task that began last, shown beside its progress. Called from several
  /// threads.
  virtual void detail(std::string_view /*text*/) {}
  /// A message for the user. Called from several threads.
  virtual void say(std::string_view /*text*/) {}
};

/// A task whose begin, progress and end are reported to `sink` (may be null).
class Task {
 public:
  Task(Progress* sink, std::string_view name, std::uint64_t total) : sink_(sink) {
    if (sink_ != nullptr) sink_->begin(name, total);
  }
  ~Task() {
    if (sink_ != nullptr) sink_->end();
  }
  Task(const Task&) = delete;
  Task& operator=(const Task&) = delete;

  void advance(std::uint64_t count = 1) {
    if (sink_ != nullptr) sink_->advance(count);
  }
  void detail(std::string_view text) {
    if (sink_ != nullptr) sink_->detail(text);
  }

 private:
  Progress* sink_;
};

}  // namespace springlod::inline base
