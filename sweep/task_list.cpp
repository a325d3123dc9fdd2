#include "sweep/task_list.hpp"

#include <system_error>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "base/file.hpp"

namespace springlod::sweep {

namespace fs = std::filesystem;

std::vector<PhaseTasks> by_phase(const Plan& plan, const std::vector<std::size_t>& tasks,
                                 std::size_t most) {
  const std::vector<Phase> phases = plan.phases();
  std::vector<PhaseTasks> lists;
  std::size_t phase = 0;
  for (const std::size_t task : tasks) {
    while (plan.stage_of(plan.tasks[task]) >= phases[phase].end) ++phase;
    if (lists.empty() || lists.back().phase != phase || lists.back().tasks.size() == most)
      lists.push_back({phase, phases[phase].alone, {}});
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
