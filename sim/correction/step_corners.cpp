#include "sim/correction/step_corners.hpp"

#include <algorithm>
#include <cmath>

#include "sim/correction/corner_law.hpp"

namespace springlod::sim {
namespace {

// Damping ratio of a corner that resists, by itself with its nodes [1]. Its damping time is then
// about that of a wave through the cell: a corner that was pressed together opens without a blow.
constexpr double kDampingRatio = 2;

// A corner moves none of its nodes by more than this fraction of its size, the cube root of its
// volume, in one step [1]: a corner deep inside out is turned back in some steps, not thrown.
constexpr double kLargestMove = 0.25;

}  // namespace

StepCorners::StepCorners(const MassSpringModel& model, bool resist)
    : model_(&model), resist_(resist) {
  for (const Corner& corner : model.corners)
    rest_volume_.push_back(corner_volume(corner, model.rest));
}

void StepCorners::begin(double step) {
  step_ = step;
  presses_.clear();
  resisting_.clear();
  inverted_.clear();
  late_inverted_.clear();
  loss_ = 0;
  largest_change_ = 0;
}

void StepCorners::check(std::uint32_t number, bool resisted, StepNodes& nodes) {
  const Corner& corner = model_->corners[number];
  Press press;
  CornerNodes from;
  CornerNodes to;
  CornerNodes middle;
  for (std::size_t i = 0; i < 4; ++i) {
    press.slot[i] = nodes.slot(corner.node[i]);
    from[i] = nodes.path(press.slot[i]).from;
    to[i] = nodes.at(press.slot[i]);
    middle[i] = 0.5 * (from[i] + to[i]);
  }
  const double rest = rest_volume_[number];
  const double start = volume_at(from) / rest;
  const double end = volume_at(to) / rest;
  if (start >= kCornerResists && end >= kCornerResists) return;
  if (!resisted && !(start > 0)) late_inverted_.push_back(number);
  if (!resist_) return note(number, end);
  press.corner = number;
  press.rest_volume = rest;
  press.before = kCornerResists - start;
  press.level = kCornerResists - end;
  press.gradient = volume_gradient(middle);
  double inertia = 0;  // sum of |gradient|^2 / m [1/(m2 kg)]
  double most = 0;     // square of the largest displacement of a node by a unit force [m2/J2]
  for (std::size_t i = 0; i < 4; ++i) {
    Vec3& gradient = press.gradient[i];
    gradient /= rest;
    press.level += gradient.dot(to[i]);
    press.mobility[i] = step_ * step_ / 2 / model_->mass[corner.node[i]];
    const double square = gradient.squaredNorm();
    inertia += press.mobility[i] * square;
    most = std::max(most, press.mobility[i] * press.mobility[i] * square);
  }
  if (!(inertia > 0)) return note(number, end);  // all four nodes in one place
  const double stiffness = corner_stiffness(corner, rest);
  // Other corners or contacts pressed it after the look of the last step.
  if (!resisted) loss_ -= penalty_energy(stiffness, press.before);
  press.law = {.stiffness = stiffness,
               .damping = std::sqrt(2 * kDampingRatio * kDampingRatio / (stiffness * inertia)),
               .mobility = inertia};
  press.largest_move = std::sqrt(most);
  presses_.push_back(press);
}

double StepCorners::linear_depth(const Press& press, const StepNodes& nodes) const {
  double depth = press.level;
  for (std::size_t i = 0; i < 4; ++i) depth -= press.gradient[i].dot(nodes.at(press.slot[i]));
  return depth;
}

void StepCorners::sweep(StepNodes& nodes) {
  for (Press& press : presses_) {
    const double free = linear_depth(press, nodes) + press.law.mobility * press.force;
    const double force = capped(press, press.law.solve(press.before, free).force);
    const double change = force - press.force;
    if (change == 0) continue;
    press.force = force;
    for (std::size_t i = 0; i < 4; ++i)
      nodes.move(press.slot[i], change * press.mobility[i] * press.gradient[i]);
  }
}

double StepCorners::capped(const Press& press, double force) {
  const double move = force * press.largest_move;
  if (move * move * move <= kLargestMove * kLargestMove * kLargestMove * press.rest_volume)
    return force;
  return kLargestMove * std::cbrt(press.rest_volume) / press.largest_move;
}

void StepCorners::finish(StepNodes& nodes) {
  for (const Press& press : presses_) {
    for (std::size_t i = 0; i < 4; ++i)
      nodes.add_corners(press.slot[i], press.force * press.mobility[i] * press.gradient[i]);
    book(press, nodes);
  }
}

// What the corner takes out of the motion is force * (linear depth at the end - at the start); the
// rest of it that the corner does not store is lost to damping, the cap, cut short sweeps, and the
// curvature of J.
void StepCorners::book(const Press& press, const StepNodes& nodes) {
  CornerNodes at;
  double work = 0;
  for (std::size_t i = 0; i < 4; ++i) {
    at[i] = nodes.at(press.slot[i]);
    work -= press.gradient[i].dot(at[i] - nodes.path(press.slot[i]).from);
  }
  const double end = volume_at(at) / press.rest_volume;
  loss_ += press.force * work - penalty_energy(press.law.stiffness, kCornerResists - end) +
           penalty_energy(press.law.stiffness, press.before);
  largest_change_ = std::max(largest_change_, std::abs(end - (kCornerResists - press.before)));
  note(press.corner, end);
}

void StepCorners::note(std::uint32_t corner, double end) {
  if (!(end >= kCornerResists)) resisting_.push_back(corner);
  if (!(end > 0)) inverted_.push_back(corner);
}

}  // namespace springlod::sim
