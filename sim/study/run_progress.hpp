#pragma once

#include <cstdint>
#include <functional>
#include <string_view>

#include "base/error.hpp"
#include "base/progress.hpp"

namespace springlod::sim {

/// Progress of one run of many: converts its steps to a fraction of the whole, and stops the run on
/// request.
class RunProgress : public Progress {
 public:
  /// Units per run, for any number of steps.
  static constexpr std::uint64_t kUnits = 1000;

  RunProgress(Progress* whole, const std::function<bool()>& stopped)
      : whole_(whole), stopped_(&stopped) {}
  void begin(std::string_view /*task*/, std::uint64_t total) override { total_ = total; }
  void advance(std::uint64_t count) override {
    if ((*stopped_)()) throw InterruptedError();
    done_ += count;
    report(kUnits * done_ / total_);
  }
  /// Reports the remaining units if a stop rule ended the run early.
  void finish() { report(kUnits); }

 private:
  void report(std::uint64_t units) {
    if (whole_ != nullptr && units > reported_) whole_->advance(units - reported_);
    reported_ = units;
  }
  Progress* whole_;
  const std::function<bool()>* stopped_;
  std::uint64_t total_ = 1;
  std::uint64_t done_ = 0;
  std::uint64_t reported_ = 0;
};

}  // namespace springlod::sim
