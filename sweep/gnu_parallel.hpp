#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "sweep/plan.hpp"

// Tasks of a plan on several machines through ssh, by GNU parallel.

namespace springlod::sweep {

struct ParallelOptions {
  std::filesystem::path program{};  ///< springlod, at the same path on every machine
  std::filesystem::path hosts{};    ///< a file of ssh logins, a line each; empty: this machine
};

/// The arguments of one call of parallel for each phase that has some of the tasks.
std::vector<std::vector<std::string>> parallel_calls(const Plan& plan,
                                                     const std::filesystem::path& folder,
                                                     const std::vector<std::size_t>& tasks,
                                                     const ParallelOptions& options);

/// The calls as a script for a shell.
std::string parallel_script(const std::vector<std::vector<std::string>>& calls);

/// Runs the calls, one after the other, and waits for them; what they print is printed here.
/// Returns how many tasks failed. Throws IoError if GNU parallel is not installed or a call fails
/// altogether.
int run_parallel(const std::vector<std::vector<std::string>>& calls);

}  // namespace springlod::sweep
