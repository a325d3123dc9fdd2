#include "base/parallel.hpp"

#include <algorithm>
#include <atomic>
#include <exception>
#include <limits>
#include <mutex>
#include <system_error>
#include <thread>
#include <vector>

#include "base/error.hpp"

namespace springlod::inline base {
namespace {

constexpr std::uint64_t kNone = std::numeric_limits<std::uint64_t>::max();

/// The lowest failed job so far. Jobs below it continue: if one of them fails too, its exception is
/// the one to report.
class Failure {
 public:
  /// Whether `job` should stop.
  bool stops(std::uint64_t job) const { return interrupted_ || job > lowest_; }

  /// Call it within a catch block.
  void keep(std::uint64_t job) {
    const std::lock_guard lock(mutex_);
    if (job >= lowest_) return;
    lowest_ = job;
    what_ = std::current_exception();
  }
  void keep_interrupt(std::uint64_t job) {
    if (stops(job)) return;  // a reaction to stopped()
    keep(job);
    interrupted_ = true;
  }
  void rethrow() const {
    if (what_) std::rethrow_exception(what_);
  }

 private:
  std::mutex mutex_;
  std::atomic<std::uint64_t> lowest_{kNone};
  std::atomic<bool> interrupted_{false};
  std::exception_ptr what_;
};

}  // namespace

void run_jobs(
    std::uint64_t count, std::uint32_t threads,
    const std::function<void(std::uint64_t job, const std::function<bool()>& stopped)>& body) {
  std::atomic<std::uint64_t> next{0};
  Failure failure;
  const auto work = [&] {
    for (std::uint64_t job = next++; job < count && !failure.stops(job); job = next++) {
      try {
        body(job, [&failure, job] { return failure.stops(job); });
      } catch (const InterruptedError&) {
        failure.keep_interrupt(job);
      } catch (...) {
        failure.keep(job);
      }
    }
  };
  const std::uint32_t cores = std::max(1U, std::thread::hardware_concurrency());
  const std::uint64_t workers = std::min<std::uint64_t>(count, threads > 0 ? threads : cores);
  std::vector<std::thread> others;
  try {
    for (std::uint64_t t = 1; t < workers; ++t) others.emplace_back(work);
  } catch (const std::system_error&) {
    // The system has no more threads: fewer do the same jobs.
  }
  work();
  for (std::thread& thread : others) thread.join();
  failure.rethrow();
}

}  // namespace springlod::inline base
