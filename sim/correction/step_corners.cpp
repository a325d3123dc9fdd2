#include "sim/correction/step_corners.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

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

StepCorners::StepCorners(const MassSpringModel& model, bool resist, const HeldNodes* held)
    : model_(&model), resist_(resist) {
  double total = 0;  // volume [m3]
  for (const Corner& corner : model.corners) {
    const double volume = corner_volume(corner, model.rest);
    kept_.push_back({.inverse_volume = 1 / volume,
                     .stiffness = corner_stiffness(corner, volume),
                     .largest_move = kLargestMove * std::cbrt(volume)});
    total += volume;
  }
  for (Kept& kept : kept_)
    kept.weight = std::min(1.0, static_cast<double>(kept_.size()) / (kept.inverse_volume * total));
  for (std::uint32_t i = 0; i < model.node_count(); ++i)
    inverse_mass_.push_back(held != nullptr && held->holds(i) ? 0 : 1 / model.mass[i]);
}

void StepCorners::begin(double step) {
  step_ = step;
  for (const std::uint32_t corner : pressed_before_) kept_[corner].force = 0;
  pressed_before_.clear();
  for (const Press& press : presses_) {
    kept_[press.corner].force = press.force;
    kept_[press.corner].is_pressed = false;
    pressed_before_.push_back(press.corner);
  }
  presses_.clear();
  started_ = 0;
  resisting_.clear();
  inverted_.clear();
  late_inverted_.clear();
  loss_ = 0;
  largest_change_ = 0;
}

void StepCorners::check(std::uint32_t number, bool resisted, StepNodes& nodes) {
  const Corner& corner = model_->corners[number];
  Kept& kept = kept_[number];
  if (kept.is_pressed) return;
  Press press;
  CornerNodes from;
  CornerNodes to;
  CornerNodes middle;
  for (std::size_t i = 0; i < 4; ++i) {
    press.slot[i] = nodes.slot(corner.node[i]);
    from[i] = nodes.path(press.slot[i]).from;
    to[i] = nodes.at(press.slot[i]);
    middle[i] = 0.5 * (from[i] + to[i] - nodes.by_corners(press.slot[i]));
  }
  const double start = volume_at(from) * kept.inverse_volume;
  const double end = volume_at(to) * kept.inverse_volume;
  if (start >= kCornerResists && end >= kCornerResists) return;
  if (!resisted && !(start > 0)) late_inverted_.push_back(number);
  if (!resist_) return note(number, end);
  kept.is_pressed = true;
  press.corner = number;
  press.before = kCornerResists - start;
  press.level = kCornerResists - end;
  press.gradient = volume_gradient(middle);
  double inertia = 0;  // sum of mobility |gradient|^2 [1/J]
  double most = 0;     // square of the largest displacement of a node by a unit force [m2/J2]
  for (std::size_t i = 0; i < 4; ++i) {
    Vec3& gradient = press.gradient[i];
    gradient *= kept.inverse_volume;
    press.level += gradient.dot(to[i]);
    press.mobility[i] = step_ * step_ / 2 * inverse_mass_[corner.node[i]];
    const double square = gradient.squaredNorm();
    inertia += press.mobility[i] * square;
    most = std::max(most, press.mobility[i] * press.mobility[i] * square);
  }
  // Other corners or contacts pressed it after the look of the last step.
  if (!resisted) loss_ -= penalty_energy(kept.stiffness, press.before);
  if (inertia > 0) {  // else all four nodes are in one place or held, and no force moves them apart
    const double damping =
        std::sqrt(2 * kDampingRatio * kDampingRatio / (kept.stiffness * inertia));
    press.law = NormalLaw({.stiffness = kept.stiffness, .damping = damping, .mobility = inertia});
    press.move = std::sqrt(most);
    press.most = kept.largest_move / press.move;
  }
  presses_.push_back(press);
}

bool StepCorners::start(StepNodes& nodes) {
  if (started_ == presses_.size()) return false;
  for (; started_ < presses_.size(); ++started_) {
    Press& press = presses_[started_];
    press.force = std::min(press.most, kept_[press.corner].force);
    if (press.force > 0) push(press, press.force, nodes);
  }
  return true;
}

double StepCorners::sweep(StepNodes& nodes) {
  double largest_change = 0;
  double largest = 0;
  for (Press& press : presses_) {
    if (press.most == 0) continue;
    const double free = linear_depth(press, nodes) + press.law.mobility() * press.force;
    const double force = std::min(press.most, press.law.solve(press.before, free).force);
    const double change = force - press.force;
    if (change != 0) push(press, change, nodes);
    press.force = force;
    largest_change = std::max(largest_change, press.move * std::abs(change));
    largest = std::max(largest, press.move * force);
  }
  return largest > 0 ? largest_change / largest : 0;
}

double StepCorners::linear_depth(const Press& press, const StepNodes& nodes) {
  const auto along = [&](std::size_t i) { return press.gradient[i].dot(nodes.at(press.slot[i])); };
  return press.level - ((along(0) + along(1)) + (along(2) + along(3)));  // pairs: shorter chain
}

void StepCorners::push(const Press& press, double force, StepNodes& nodes) {
  for (std::size_t i = 0; i < 4; ++i)
    nodes.move(press.slot[i], force * press.mobility[i] * press.gradient[i]);
}

void StepCorners::count(StepNodes& nodes) {
  for (Press& press : presses_) {
    const double force = press.force - std::exchange(press.counted, press.force);
    for (std::size_t i = 0; i < 4; ++i)
      nodes.count_by_corner(press.slot[i], force * press.mobility[i] * press.gradient[i]);
  }
}

void StepCorners::finish(StepNodes& nodes) {
  for (const Press& press : presses_) {
    book(press, nodes);
    for (std::size_t i = 0; i < 4; ++i)
      if (nodes.is_held(press.slot[i]))
        nodes.absorb(press.slot[i], step_ * press.force * press.gradient[i]);
  }
}

// What the corner takes out of the motion is force * (linear depth at the end - at the start); the
// rest of it that the corner does not store is lost to damping, the cap, the error of the sweeps,
// and the curvature of J.
void StepCorners::book(const Press& press, const StepNodes& nodes) {
  CornerNodes at;
  double work = 0;
  for (std::size_t i = 0; i < 4; ++i) {
    at[i] = nodes.at(press.slot[i]);
    work -= press.gradient[i].dot(at[i] - nodes.path(press.slot[i]).from);
  }
  const Kept& kept = kept_[press.corner];
  const double end = volume_at(at) * kept.inverse_volume;
  loss_ += press.force * work - penalty_energy(kept.stiffness, kCornerResists - end) +
           penalty_energy(kept.stiffness, press.before);
  const double depth = std::max(0.0, kCornerResists - end);
  const double opened = end - (kCornerResists - press.before);
  largest_change_ = std::max({largest_change_, std::abs(depth - std::max(0.0, press.before)),
                              kept.weight * std::abs(opened)});
  note(press.corner, end);
}

void StepCorners::note(std::uint32_t corner, double end) {
  if (!(end >= kCornerResists)) resisting_.push_back(corner);
  if (!(end > 0)) inverted_.push_back(corner);
}

}  // namespace springlod::sim
