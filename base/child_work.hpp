#pragma once

#include <cstdint>
#include <functional>
#include <string>

#include "base/error.hpp"
#include "base/progress.hpp"

namespace springlod::inline base {

/// Limits of work in a child process.
struct ChildLimits {
  double seconds = 10;                            ///< of processor time; by the clock, twice that
  std::uint64_t memory = std::uint64_t{4} << 30;  ///< in addition to that of this process [bytes]
  std::uint64_t result = std::uint64_t{4} << 30;  ///< [bytes]
};

/// Work in a child process gave no result: it crashed or exceeded a limit. The message says what
/// happened: "crashed (Segmentation fault)".
class ChildFailure : public Error {
 public:
  using Error::Error;
};

/// Calls `work` in a child process, a copy of this one, and returns its result, so that a crash or
/// hang of `work` does no harm. `work` must not need other threads of this process, and what it
/// prints is discarded. An InputError or IoError that it throws is thrown here with the same
/// message; other exceptions, crashes and exceeded limits throw ChildFailure. `progress` (may be
/// null) is asked ten times a second whether to stop. Memory is not limited under sanitizers.
std::string run_in_child(const std::function<std::string()>& work, const ChildLimits& limits,
                         Progress* progress = nullptr);

}  // namespace springlod::inline base
