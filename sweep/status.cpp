#include "sweep/status.hpp"

namespace springlod::sweep {

namespace {

/// Calls visit(unit, state, cost) for all units.
template <class Visit>
void for_each_unit(const Plan& plan, const UnitFiles& files, Visit visit) {
  const std::vector<UnitNotes> notes = files.list(0, plan.unit_count());
  std::uint64_t unit = 0;
  for (const CostRun& run : plan.costs)
    for (const std::uint64_t end = unit + run.units; unit < end; ++unit)
      visit(unit, notes[unit].state, run.cost);
}

}  // namespace

Status status_of(const Plan& plan, const UnitFiles& files) {
  Status status{.units = plan.unit_count()};
  double cost_left = 0;
  for_each_unit(plan, files, [&](std::uint64_t, UnitState state, double cost) {
    switch (state) {
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
  std::vector<std::size_t> tasks;
  std::size_t task = 0;
  for_each_unit(plan, files, [&](std::uint64_t unit, UnitState state, double) {
    while (unit >= plan.end_of_task(task)) ++task;
    if (needs_run(state) && (tasks.empty() || tasks.back() != task)) tasks.push_back(task);
  });
  return tasks;
}

}  // namespace springlod::sweep
