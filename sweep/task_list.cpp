#include "sweep/task_list.hpp"

#include <system_error>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "base/file.hpp"

namespace springlod::sweep {

namespace fs = std::filesystem;

std::vector<StageTasks> by_stage(const Plan& plan, const std::vector<std::size_t>& tasks,
                                 std::size_t most) {
  std::vector<StageTasks> lists;
  for (const std::size_t task : tasks) {
    const std::size_t stage = plan.stage_of(plan.tasks[task]);
    if (lists.empty() || lists.back().stage != stage || lists.back().tasks.size() == most)
      lists.push_back({stage, {}});
    lists.back().tasks.push_back(task);
  }
  return lists;
}

fs::path write_task_list(const fs::path& folder, const std::vector<std::size_t>& tasks) {
  std::error_code ignored;
  int number = 1;
  const auto path = [&] { return folder / "jobs" / fmt::format("tasks-{}.txt", number); };
  while (fs::exists(path(), ignored)) ++number;
  write_text_file(path(), fmt::format("{}\n", fmt::join(tasks, "\n")));
  return path();
}

}  // namespace springlod::sweep
