#pragma once

#include <cstdint>
#include <functional>

namespace springlod::inline base {

/// Calls body(job, stopped) for every job below `count`, in rising order, each once, spread over
/// `threads` threads (0: all cores). If jobs throw, the exception of the lowest one reaches the
/// caller, whatever the thread count: later jobs are not started any more, and those under way see
/// stopped() turn true and should throw InterruptedError. An InterruptedError that no failed job
/// caused stops the earlier jobs too.
void run_jobs(
    std::uint64_t count, std::uint32_t threads,
    const std::function<void(std::uint64_t job, const std::function<bool()>& stopped)>& body);

}  // namespace springlod::inline base
