#pragma once

#include <cstdint>
#include <functional>
#include <string_view>

#include "model/progress.hpp"

namespace springlod {

/// Turns the steps of one run into its share of many and stops the run when asked to.
class RunProgress : public Progress {
 public:
  /// Units of progress in one run, whatever its number of steps.
  static constexpr std::uint64_t kUnits = 1000;

  /// `whole` may be null.
  RunProgress(Progress* whole, const std::function<bool()>& stopped)
      : whole_(whole), stopped_(&stopped) {}
  void begin(std::string_view task, std::uint64_t total) override;
  void advance(std::uint64_t count) override;
  /// What is left when a run ended early.
  void finish() { report(kUnits); }

 private:
  void report(std::uint64_t units);

  Progress* whole_;
  const std::function<bool()>* stopped_;
  std::uint64_t total_ = 1;
  std::uint64_t done_ = 0;
  std::uint64_t reported_ = 0;
};

}  // namespace springlod
