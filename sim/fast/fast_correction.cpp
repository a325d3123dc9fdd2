#include "sim/fast/fast_correction.hpp"

#include <algorithm>
#include <cmath>

namespace springlod::sim {

FastCorrection::FastCorrection(const Shared& shared)
    : shared_(shared),
      needed_(!shared.points.obstacles->empty() || !shared.model->corners.empty()),
      paths_(*shared.body, shared.model->node_count()),
      near_(shared.points, paths_),
      watch_(shared.model->corner_count()),
      pressed_at_(shared.model->node_count(), 0),
      found_(shared.body->block_count()),
      dues_(shared.body->block_count()),
      solver_(*shared.model, *shared.points.points, *shared.points.finder, shared.volumes) {}

void FastCorrection::correct(const FastStep& step) {
  paths_.begin(step);
  solver_.begin(step.length, paths_);
  shown_.clear();
  shift_ = 0;
  near_.check(step, solver_);
  solver_.solve_contacts();
  solver_.solve_resisting(watch_);
}

// A contact takes back most of the drift of a node that it presses, and so does a corner. The nodes
// that they moved in the last step or in this one count with their displacement by all together.
double FastCorrection::take_travel(const FastStep& step) {
  Vec3 largest = Vec3::Zero();
  for (std::uint32_t b = 0; b < shared_.body->block_count(); ++b)
    largest = largest.cwiseMax(shared_.body->largest_departure(b));
  double most = largest.squaredNorm();
  const RigidMotion& rigid = shared_.body->rigid_motion();
  const auto departure = [&](const StepPath& path) -> Vec3 {
    const Vec3 velocity = step.after.velocity + rigid.at(path.to - step.after.origin);
    return path.to - path.from - step.length * velocity;
  };
  const StepNodes& nodes = solver_.nodes();
  for (std::uint32_t i = 0; i < nodes.count(); ++i) {
    most = std::max(most, (departure(nodes.path(i)) + nodes.displacement(i)).squaredNorm());
    pressed_at_[nodes.node(i)] = step.number;
  }
  for (const std::uint32_t node : pressed_) {
    if (pressed_at_[node] == step.number) continue;
    most = std::max(most, departure(paths_.path(node)).squaredNorm());
    shared_.body->count_departure(shared_.body->place(node), true);
  }
  pressed_.clear();
  for (std::uint32_t i = 0; i < nodes.count(); ++i) {
    pressed_.push_back(nodes.node(i));
    shared_.body->count_departure(shared_.body->place(nodes.node(i)), false);
  }
  solver_.take_travel();  // this part is counted
  return std::sqrt(most);
}

bool FastCorrection::corners_due(double travel) {
  looking_ = watch_.moved(travel);
  if (!looking_) return false;
  show_nodes();
  look_ = {watch_.travel(), shared_.body->farthest_coordinate()};
  return true;
}

// A look must find the nodes where the contacts and corners have left them.
void FastCorrection::show_nodes() {
  const StepNodes& nodes = solver_.nodes();
  shown_.resize(nodes.count(), Vec3::Zero());
  for (std::uint32_t i = 0; i < nodes.count(); ++i) {
    const Vec3 displacement = nodes.displacement(i);
    shared_.body->shift(shared_.body->place(nodes.node(i)), displacement - shown_[i], Vec3::Zero());
    shown_[i] = displacement;
  }
}

void FastCorrection::look_at_corners(std::uint32_t block) {
  found_[block].clear();
  dues_[block] = shared_.body->find_corners(block, look_, found_[block]);
}

void FastCorrection::finish_look() {
  for (const std::vector<std::uint32_t>& of_block : found_) watch_.found(of_block);
  watch_.looked(*std::min_element(dues_.begin(), dues_.end()));
  looking_ = false;
}

bool FastCorrection::solve_corners() {
  if (looking_) finish_look();
  watch_.check(
      [&](std::uint32_t corner, bool resisted) { solver_.check_corner(corner, resisted); });
  return solver_.solve_corners() && corners_due(shifted());
}

double FastCorrection::shifted() {
  const double shift = solver_.take_travel();
  shift_ += shift;
  return shift;
}

void FastCorrection::finish(const FastStep& step) {
  solver_.finish();
  watch_.corrected(shifted(), solver_.resisting());
  apply(step);
  near_.check_walls(step);
  note_inversions(step);
}

void FastCorrection::apply(const FastStep& step) {
  double most = 0;
  shown_.resize(solver_.changes().size(), Vec3::Zero());
  auto shown = shown_.begin();  // in the order of StepNodes, as the changes
  for (const NodeChange& change : solver_.changes()) {
    shared_.body->shift(shared_.body->place(change.node), change.displacement - *shown++,
                        change.kick);
    paths_.shift(change.node, change.displacement);
    most = std::max(most, change.displacement.squaredNorm());
  }
  near_.corrected(std::sqrt(most));
  if (!first_step_ && !contacts().empty()) first_step_ = step.number;
  if (!shared_.with_ledger) return;
  losses_.contact += solver_.losses().contact;
  losses_.friction += solver_.losses().friction;
  losses_.corners += solver_.losses().corners;
  for (const NodeChange& change : solver_.changes()) {
    losses_.contact += half_work(change.node, change.by_contacts(step.length));
    losses_.friction += half_work(change.node, change.by_friction(step.length));
    losses_.corners += half_work(change.node, change.by_corners);
  }
  booked_step_ = step.length;
}

void FastCorrection::book_end() {
  if (booked_step_ == 0) return;
  for (const NodeChange& change : solver_.changes()) {
    losses_.contact -= half_work(change.node, change.by_contacts(booked_step_));
    losses_.corners -= half_work(change.node, change.by_corners);
  }
  booked_step_ = 0;
}

// See LedgerEntry. The damping forces take their own part.
double FastCorrection::half_work(std::uint32_t node, const Vec3& displacement) const {
  const Place at = shared_.body->place(node);
  const Vec3 force = shared_.body->force(at) - shared_.body->damping_force(at) +
                     shared_.model->mass[node] * shared_.gravity;
  return 0.5 * force.dot(displacement);
}

void FastCorrection::note_inversions(const FastStep& step) {
  largest_corner_change_ = std::max(largest_corner_change_, solver_.largest_corner_change());
  inversions_.note(
      step.number, solver_.inverted(), solver_.late_inverted(),
      [&](std::uint32_t corner) { return paths_.to(shared_.model->corners[corner].node[0]); });
}

}  // namespace springlod::sim
