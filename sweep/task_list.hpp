#pragma once

#include <cstdint>
#include <filesystem>
#include <vector>

#include "sweep/plan.hpp"

namespace springlod::sweep {

/// Tasks that may run at the same time.
struct PhaseTasks {
  std::size_t phase = 0;
  bool alone = false;  ///< one at a time on a machine, see Stage
  std::vector<std::size_t> tasks{};
};

/// The tasks, which ascend, in lists of one phase and of at most `most` each.
std::vector<PhaseTasks> by_phase(const Plan& plan, const std::vector<std::size_t>& tasks,
                                 std::size_t most);

/// Writes the numbers of tasks, a line each, to a new file in the folder jobs. Throws IoError.
std::filesystem::path write_task_list(const std::filesystem::path& folder,
                                      const std::vector<std::size_t>& tasks);

}  // namespace springlod::sweep
