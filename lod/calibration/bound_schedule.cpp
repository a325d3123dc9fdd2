#include "lod/calibration/bound_schedule.hpp"

#include <algorithm>
#include <cmath>
#include <functional>

namespace springlod::lod {
namespace {

/// Least factor on the bound in a step (docs/method.md, eq. 46).
constexpr double kTighten = 0.8;
/// Least ratio of the bound to the largest squared node frequency. With a smaller ratio nearly all
/// nodes would be constrained instead of the stiffest.
constexpr double kLeastBound = 0.68;
/// F has settled when kIdle steps in a row lowered it by less than the fraction kWorthwhile, or
/// after kPatience steps with the same bound.
constexpr double kWorthwhile = 0.05;
constexpr std::uint32_t kIdle = 2, kPatience = 8;
/// Steps that refine a level once its omega_max is low enough.
constexpr std::uint32_t kRefine = 2;
/// Tolerances that a level never meets become its errors times this.
constexpr double kSlack = 1.1;

}  // namespace

bool BoundSchedule::next(const SteppedLevel& level) {
  const bool has_settled = settled(level);
  if (state.refined > 0) return ++state.refined <= kRefine;
  if (!(state.within > 0) && state.idle >= kIdle) give_slack(level.ratios);
  if (within_tolerance(level.ratios)) {
    state.within = state.bound;
    if (low_enough(level.frequency)) return ++state.refined <= kRefine;
    lower(level);
    return true;
  }
  return !has_settled || !(state.within > 0) || take_back_half();
}

bool BoundSchedule::within_tolerance(const ErrorRatios& ratios) const {
  return std::equal(ratios.begin(), ratios.end(), state.slack.begin(), std::less_equal());
}

bool BoundSchedule::settled(const SteppedLevel& level) {
  const bool idle = state.steps > 0 && level.merit > (1 - kWorthwhile) * state.merit;
  state.idle = idle ? state.idle + 1 : 0;
  state.merit = level.merit;
  ++state.steps;
  return state.idle >= kIdle || state.steps >= kPatience;
}

void BoundSchedule::give_slack(const ErrorRatios& ratios) {
  for (std::size_t kind = 0; kind < ratios.size(); ++kind)
    state.slack[kind] = std::max(1.0, kSlack * ratios[kind]);
}

void BoundSchedule::lower(const SteppedLevel& level) {
  const double above = level.frequency / wanted_;
  change(std::max(std::max(kTighten, 1 / (above * above)) * std::min(state.bound, level.node_bound),
                  kLeastBound * level.node_bound));
}

bool BoundSchedule::take_back_half() {
  if (state.took_back) return false;
  state.took_back = true;
  change(std::sqrt(state.within * state.bound));
  return true;
}

void BoundSchedule::change(double bound) {
  state.bound = bound;
  state.steps = 0;
  state.idle = 0;
}

}  // namespace springlod::lod
