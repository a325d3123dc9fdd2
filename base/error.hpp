#pragma once

#include <cstdint>
#include <stdexcept>
#include <string>
#include <utility>

namespace springlod::inline base {

/// Base of every error that springlod throws itself. The message states what is wrong, where, and
/// what to do next.
class Error : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// A value, option or model given by the caller is invalid.
class InputError : public Error {
 public:
  using Error::Error;
};

/// A file cannot be read, parsed or written.
class IoError : public Error {
 public:
  using Error::Error;
};

/// A simulation diverged. Holds the first node whose state is not finite, and the time.
class UnstableError : public Error {
 public:
  UnstableError(const std::string& message, std::uint32_t node, double time)
      : Error(message), node_(node), time_(time) {}
  std::uint32_t node() const { return node_; }  ///< counted from 0
  /// Simulated time [s].
  double time() const { return time_; }

 private:
  std::uint32_t node_;
  double time_;
};

/// A node passed through an obstacle: its displacement in one step exceeded the thickness, or the
/// obstacle was too soft to hold it. The run would no longer follow the scenario.
class TunnelError : public Error {
 public:
  TunnelError(const std::string& message, std::uint32_t node, std::string obstacle, double time)
      : Error(message), node_(node), obstacle_(std::move(obstacle)), time_(time) {}
  std::uint32_t node() const { return node_; }  ///< counted from 0
  const std::string& obstacle() const { return obstacle_; }
  /// Simulated time at the end of that step [s].
  double time() const { return time_; }

 private:
  std::uint32_t node_;
  std::string obstacle_;
  double time_;
};

/// The user asked to stop (Ctrl-C).
class InterruptedError : public Error {
 public:
  InterruptedError() : Error("interrupted") {}
};

}  // namespace springlod::inline base
