#include "sweep/status.hpp"

namespace springlod::sweep {

Status status_of(const Plan& plan, const UnitFiles& files) {
  Status status{.units = plan.unit_count()};
  const std::vector<UnitNotes> notes = files.list(0, status.units);
  double cost_left = 0;
  for_each_unit(plan, [&](std::uint64_t unit, double cost) {
    switch (notes[unit].state) {
      case UnitState::done:
        ++status.done;
        return;
      case UnitState::failed:
        ++status.failed;
        return;
      case UnitState::lost:
        ++status.lost;
        return;
      case UnitState::running:
        ++status.running;
        break;
      case UnitState::missing:
      case UnitState::waiting:
        ++status.missing;
        break;
    }
    cost_left += cost;
  });
  status.seconds_left = cost_left * plan.seconds_per_cost;
  return status;
}

std::vector<std::size_t> unfinished_tasks(const Plan& plan, const UnitFiles& files) {
  const std::vector<UnitNotes> notes = files.list(0, plan.unit_count());
  std::vector<std::size_t> tasks;
  std::size_t task = 0;
  for (std::uint64_t unit = 0; unit < notes.size(); ++unit) {
    while (unit >= plan.end_of_task(task)) ++task;
    if (needs_run(notes[unit].state) && (tasks.empty() || tasks.back() != task))
      tasks.push_back(task);
  }
  return tasks;
}

}  // namespace springlod::sweep
