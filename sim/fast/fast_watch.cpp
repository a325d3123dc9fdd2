#include "sim/fast/fast_watch.hpp"

#include <algorithm>
#include <cmath>

namespace springlod::sim {
namespace {

// The springs are looked at no more often than this [steps]: a look costs up to half a step, and
// within so few steps a body is not strained so much more that its step becomes unstable.
constexpr std::uint32_t kLookEvery = 4;

// Interval between two fits of the rigid motion [steps]: short for a bounce, which takes about a
// hundred steps. A fit costs as much as about ten nodes of a step in each of these steps.
constexpr std::uint64_t kFollowEvery = 16;

}  // namespace

void FastWatch::set(const Stepper::Watch& limits) {
  limits_ = limits;
  stopped_ = false;
}

void FastWatch::plan(const FastStep& step, FastCorrection& correction) {
  const double travel = correction.take_travel(step);
  travel_ += travel;
  at_corners_ = correction.corners_due(travel);
  at_springs_ = ++steps_ >= kLookEvery && largest_strain() > limits_.strain;
  saw_springs_ = at_springs_;
}

// A spring becomes longer or shorter by at most twice the travel.
double FastWatch::largest_strain() const {
  return strain_ + 2 * travel_ / shortest_;
}

void FastWatch::look(std::uint32_t block, const FastBody& body, FastCorrection& correction) {
  if (at_corners_) correction.look_at_corners(block);
  if (at_springs_) strains_[block] = body.largest_strain(block);
}

void FastWatch::solve_corners(FastCorrection& correction) {
  at_springs_ = false;
  at_corners_ = correction.solve_corners();
}

void FastWatch::finish(const FastStep& step, FastBody& body, const FastCorrection& correction) {
  if (step.number % kFollowEvery == 0) follow(body);
  if (saw_springs_) {
    strain_ = *std::max_element(strains_.begin(), strains_.end());
    travel_ = 0;
    steps_ = 0;
  }
  travel_ += correction.shift();
  Vec3 most = Vec3::Zero();
  for (std::uint32_t b = 0; b < body.block_count(); ++b)
    most = most.cwiseMax(body.largest_displacement(b));
  const double speed = step.after.velocity.norm() + most.norm() / step.length;
  stopped_ = speed > limits_.speed || (saw_springs_ && strain_ > limits_.strain) ||
             correction.largest_corner_change() > limits_.corner_change;
}

}  // namespace springlod::sim
