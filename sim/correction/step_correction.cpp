#include "sim/correction/step_correction.hpp"

namespace springlod::sim {
namespace {

// Sweeps over the corners in a step [1]. Corners that are cut short yield a little more within the
// step; the ledger holds the difference as their loss.
constexpr int kCornerSweeps = 2;

}  // namespace

void StepCorrection::begin(double step, const StepPaths& paths) {
  step_ = step;
  nodes_.begin(paths);
  contacts_.begin(step);
  corners_.begin(step);
  changes_.clear();
  losses_ = {};
}

void StepCorrection::solve_contacts() {
  if (!contacts_.empty()) contacts_.solve(nodes_);
}

// The contacts come last, so that no corner presses a node into an obstacle.
void StepCorrection::finish() {
  if (!corners_.empty()) {
    for (int i = 0; i < kCornerSweeps; ++i) {
      corners_.sweep(nodes_);
      if (!contacts_.empty()) contacts_.sweep(nodes_);
    }
    if (!contacts_.empty()) contacts_.solve(nodes_);
  }
  contacts_.finish(nodes_);
  corners_.finish(nodes_);
  nodes_.finish(step_, changes_);
  losses_ = {contacts_.losses().contact, contacts_.losses().friction, corners_.loss()};
}

}  // namespace springlod::sim
