#pragma once

#include <cstdint>
#include <stdexcept>
#include <string>
#include <utility>

namespace springlod::inline base {

/// Base of every error that springlod throws on purpose. The message says what is wrong, where,
/// and what to do next.
class Error : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// A value, option or model that the caller handed over is wrong.
class InputError : public Error {
 public:
  using Error::Error;
};

/// A file cannot be read, understood or written.
class IoError : public Error {
 public:
  using Error::Error;
};

/// A simulation diverged: names the first node that did and when.
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

/// A node went through an obstacle that is thinner than its way in one step, or too soft to hold
/// it: what the run would go on with has nothing to do with the scenario any more.
class TunnelError : public Error {
 public:
  TunnelError(const std::string& message, std::uint32_t node, std::string obstacle, double time)
      : Error(message), node_(node), obstacle_(std::move(obstacle)), time_(time) {}
  std::uint32_t node() const { return node_; }  ///< counted from 0
  const std::string& obstacle() const { return obstacle_; }
  /// Simulated time at the end of the step that did it [s].
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
