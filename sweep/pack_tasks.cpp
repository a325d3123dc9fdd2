#include "sweep/pack_tasks.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

namespace springlod::sweep {

namespace {

/// Number of tasks for `seconds` of short units. If it can be divided by small numbers, then few
/// processors end at the same time.
double task_count(double seconds) {
  constexpr double kAim = (kShortestTask + kLongestTask) / 2;
  for (const double divisor : {12, 6, 4, 2}) {
    const double count = divisor * std::round(seconds / kAim / divisor);
    if (count > 0 && seconds / count >= kShortestTask && seconds / count <= kLongestTask)
      return count;
  }
  return std::max(1.0, std::round(seconds / kAim));
}

/// The units of a stage that are shorter than a task, as far as they are not packed yet.
struct Unpacked {
  double seconds = 0;
  double tasks = 0;
  /// What the next task should take [s].
  double length() const {
    return std::clamp(seconds / std::max(1.0, tasks), kShortestTask, kLongestTask);
  }
};

std::vector<Unpacked> unpacked_stages(const Plan& plan) {
  std::vector<Unpacked> stages(plan.stages.size());
  std::size_t stage = 0;
  std::uint64_t end_of_stage = plan.stages.front().units;
  for_each_unit(plan, [&](std::uint64_t unit, double cost) {
    if (unit == end_of_stage) end_of_stage += plan.stages[++stage].units;
    const double each = cost * plan.seconds_per_cost;
    if (each < kLongestTask) stages[stage].seconds += each;
  });
  for (Unpacked& one : stages) one.tasks = task_count(one.seconds);
  return stages;
}

}  // namespace

void pack_tasks(Plan& plan) {
  std::vector<Unpacked> unpacked = unpacked_stages(plan);
  plan.tasks.clear();
  std::size_t stages = 0;  // that have begun
  std::uint64_t end_of_stage = 0;
  double seconds = 0, length = 0;
  for_each_unit(plan, [&](std::uint64_t unit, double cost) {
    const double each = cost * plan.seconds_per_cost;
    const bool new_stage = unit == end_of_stage;
    // The nearer of two ends to what a task should take.
    const bool full = seconds > 0 && seconds + each / 2 > length;
    if (new_stage) end_of_stage += plan.stages[stages++].units;
    Unpacked& left = unpacked[stages - 1];
    const bool is_short = each < kLongestTask;
    if (new_stage || full) {
      plan.tasks.push_back(unit);
      length = left.length();
      seconds = 0;
      if (is_short) left.tasks -= 1;
    }
    seconds += each;
    if (is_short) left.seconds -= each;
  });
}

}  // namespace springlod::sweep
