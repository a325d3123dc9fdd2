#include "sim/fast/fast_correction.hpp"

#include <algorithm>
#include <cmath>

namespace springlod::sim {

FastCorrection::FastCorrection(const Shared& shared)
    : shared_(shared),
      needed_(!shared.points.obstacles->empty() || !shared.model->corners.empty() ||
              !shared.holds.held->empty() || !shared.holds.springs->empty()),
      paths_(*shared.body, shared.model->node_count()),
      near_(shared.points, paths_),
      watch_(shared.model->corner_count()),
      found_(shared.body->block_count()),
      dues_(shared.body->block_count()),
      solver_(*shared.model, *shared.points.points, *shared.points.finder, shared.volumes,
              shared.holds) {}

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
  const Padded origin = padded(step.after.origin);
  const Padded common = padded(step.after.velocity);
  const Padded velocity = padded(rigid.velocity);
  const Padded spin = padded(rigid.spin);
  const auto count = [&](const Padded& from, const Padded& to, const Padded& displacement) {
    const Padded carried = step.length * (common + (velocity + cross(spin, to - origin)));
    const Padded departure = to - from - carried + displacement;
    most = std::max(most, dot(departure, departure));
  };
  const StepNodes& nodes = solver_.nodes();
  for (std::uint32_t i = 0; i < nodes.count(); ++i) {
    const PaddedPath& path = nodes.paths()[i];
    count(path.from, path.to, nodes.all_at()[i] - path.to);
  }
  if (pressed_ != nodes.nodes()) {
    for (const std::uint32_t node : pressed_) {
      const StepPath& path = paths_.path(node);
      if (!nodes.has(node)) count(padded(path.from), padded(path.to), Padded::Zero());
    }
    shared_.body->count_departures(pressed_, true);
    pressed_ = nodes.nodes();
    shared_.body->count_departures(pressed_, false);
  }
  solver_.take_travel();  // what has moved so far is counted
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
  unseen_.clear();
  for (std::uint32_t i = 0; i < nodes.count(); ++i) {
    const Vec3 displacement = nodes.displacement(i);
    NodeChange& unseen = unseen_.emplace_back();
    unseen.node = nodes.node(i);
    unseen.displacement = displacement - shown_[i];
    shown_[i] = displacement;
  }
  shared_.body->shift(unseen_);
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
  near_.check_walls(step, solver_.nodes());
  note_inversions(step);
}

void FastCorrection::apply(const FastStep& step) {
  double most = 0;
  for (const NodeChange& change : solver_.changes())
    most = std::max(most, change.displacement.squaredNorm());
  near_.corrected(std::sqrt(most));
  if (shown_.empty()) {
    shared_.body->shift(solver_.changes());
  } else {
    unseen_ = solver_.changes();  // in the order of StepNodes
    for (std::size_t i = 0; i < shown_.size(); ++i) unseen_[i].displacement -= shown_[i];
    shared_.body->shift(unseen_);
  }
  if (!first_step_ && !contacts().empty()) first_step_ = step.number;
  if (!shared_.with_ledger) return;
  losses_.contact += solver_.losses().contact;
  losses_.friction += solver_.losses().friction;
  losses_.corners += solver_.losses().corners;
  losses_.anchors += solver_.losses().anchors;
  const StepCorrection::Losses work = half_work(step.length);
  losses_.contact += work.contact;
  losses_.friction += work.friction;
  losses_.corners += work.corners;
  losses_.anchors += work.anchors;
  booked_step_ = step.length;
}

void FastCorrection::book_end() {
  if (booked_step_ == 0) return;
  const StepCorrection::Losses work = half_work(booked_step_);
  losses_.contact -= work.contact;
  losses_.corners -= work.corners;
  losses_.anchors -= work.anchors;
  booked_step_ = 0;
}

// See LedgerEntry. The damping forces take their own part.
StepCorrection::Losses FastCorrection::half_work(double step) {
  forces_.resize(solver_.changes().size());
  shared_.body->get_elastic_forces(solver_.nodes().nodes(), forces_);
  StepCorrection::Losses work;
  auto elastic = forces_.begin() + solver_.nodes().held_count();  // by node, as the changes
  for (const NodeChange& change : solver_.free_changes()) {
    const Vec3 half = 0.5 * (*elastic++ + shared_.model->mass[change.node] * shared_.gravity);
    work.contact += half.dot(change.by_contacts(step));
    work.friction += half.dot(change.by_friction(step));
    work.corners += half.dot(change.by_corners);
    work.anchors += half.dot(change.by_spring);
  }
  return work;
}

void FastCorrection::note_inversions(const FastStep& step) {
  largest_corner_change_ = std::max(largest_corner_change_, solver_.largest_corner_change());
  inversions_.note(step.number, solver_.inverted(), solver_.late_inverted(),
                   [&](std::uint32_t corner) -> Vec3 {
                     const std::uint32_t node = shared_.model->corners[corner].node[0];
                     return solver_.nodes().corrected_path(node).to;
                   });
}

}  // namespace springlod::sim
