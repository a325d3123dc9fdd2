#include "sim/correction/step_correction.hpp"

#include <algorithm>

namespace springlod::sim {
namespace {

// The sweeps over corners and contacts end when none of them moves a node by more than this
// fraction of the largest displacement by a corner or contact [1]. Corners and contacts that press
// against each other take many sweeps and undo each other when these are cut short; the ledger
// holds the difference as a loss.
constexpr double kTolerance = 1e-2;
constexpr int kMostSweeps = 16;

// Corners that are pressed by the last round are found in the next step, and the energy that they
// got is booked as a gain [rounds].
constexpr int kMostRounds = 3;

}  // namespace

void StepCorrection::begin(double step, const StepPaths& paths) {
  step_ = step;
  rounds_ = 0;
  contacts_.begin(step, paths, nodes_);
  corners_.begin(step);
  springs_.begin(step, nodes_);
  changes_.clear();
  losses_ = {};
}

void StepCorrection::solve_contacts() {
  nodes_.keep();
  for (int i = 0; i < kMostSweeps && !springs_.empty(); ++i) {
    const double change = springs_.sweep(nodes_);
    if (!nodes_.shared() || (i > 0 && change < kTolerance)) break;
    contacts_.solve(nodes_);
  }
  contacts_.solve(nodes_);
}

void StepCorrection::solve_resisting(const CornerWatch& watch) {
  if (!corners_.resist()) return;
  watch.check_resisting([&](std::uint32_t corner) { check_corner(corner, true); });
  solve_together();
}

// The contacts come last, so that no corner presses a node into an obstacle.
bool StepCorrection::solve_together() {
  if (!corners_.start(nodes_)) return false;
  double change = 1;
  for (int i = 0; i < kMostSweeps && change > kTolerance; ++i) {
    change = corners_.sweep(nodes_);
    change = std::max(change, springs_.sweep(nodes_));
    change = std::max(change, contacts_.sweep(nodes_));
    if (!nodes_.shared()) break;
  }
  corners_.count(nodes_);
  contacts_.solve(nodes_);
  return true;
}

bool StepCorrection::solve_corners() {
  return solve_together() && ++rounds_ < kMostRounds;
}

void StepCorrection::finish() {
  contacts_.finish(nodes_);
  corners_.finish(nodes_);
  springs_.finish(nodes_);
  nodes_.finish(step_, changes_);
  losses_ = {contacts_.losses().contact, contacts_.losses().friction, corners_.loss(),
             springs_.loss()};
}

}  // namespace springlod::sim
