#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "base/progress.hpp"
#include "sweep/plan.hpp"
#include "sweep/unit_files.hpp"

namespace springlod::sweep {

struct RunOptions {
  /// The program that runs units: it calls serve_units with the descriptor kExtraStream. `log`:
  /// the file that it prints to, below the folder of the plan.
  std::filesystem::path program{};
  std::function<std::vector<std::string>(const std::string& log)> arguments{};
  std::uint32_t workers = 1;          ///< processes at a time; 1 for units that run alone
  std::optional<std::size_t> task{};  ///< runs this one only, counted from 0
  Progress* progress = nullptr;       ///< may be null
};

/// What a call of run_plan has done. Units that were done before are not counted.
struct RunCounts {
  std::uint64_t done = 0;
  std::uint64_t failed = 0;  ///< by themselves
  std::uint64_t lost = 0;    ///< given up after kMostTries
};

/// Runs the units of a plan that need it, phase by phase, in processes of their own: a unit that
/// takes its process down does no harm to others. It is tried again if the process was killed, and
/// has failed if it crashed. Waits for units that others are running. What the processes print
/// goes to files in the folder logs. Throws IoError with the message of a process that cannot work
/// (a full disk, a script with an error), InterruptedError if the user stops it.
RunCounts run_plan(const Plan& plan, const UnitFiles& files, const RunOptions& options);

}  // namespace springlod::sweep
