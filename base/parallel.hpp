#pragma once

#include <cstdint>
#include <functional>

namespace springlod::inline base {

/// Calls body(job, stopped) once for every job below `count`, in ascending order, on `threads`
/// threads (0: all cores).
///
/// If jobs throw, the exception of the lowest failed job reaches the caller, for any number of
/// threads. No further jobs are started then; for running jobs stopped() becomes true, and they
/// should throw InterruptedError. An InterruptedError that is not a reaction to stopped() stops the
/// earlier jobs too.
void run_jobs(
    std::uint64_t count, std::uint32_t threads,
    const std::function<void(std::uint64_t job, const std::function<bool()>& stopped)>& body);

}  // namespace springlod::inline base
