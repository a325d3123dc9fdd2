#pragma once

#include <cstdint>
#include <filesystem>
#include <vector>

#include "sweep/plan.hpp"

namespace springlod::sweep {

/// Tasks that may run at the same time.
struct StageTasks {
  std::size_t stage = 0;
  std::vector<std::size_t> tasks{};
};

/// The tasks, which ascend, in lists of one stage and of at most `most` each.
std::vector<StageTasks> by_stage(const Plan& plan, const std::vector<std::size_t>& tasks,
                                 std::size_t most);

/// Writes the numbers of tasks, a line each, to a new file in the folder jobs. Throws IoError.
std::filesystem::path write_task_list(const std::filesystem::path& folder,
                                      const std::vector<std::size_t>& tasks);

}  // namespace springlod::sweep
