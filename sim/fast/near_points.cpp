#include "sim/fast/near_points.hpp"

#include <algorithm>
#include <cmath>
#include <span>

#include "sim/fast/regions.hpp"

namespace springlod::sim {
namespace {

// Bounds and displacements are widened by this fraction [1], so that rounding to single precision
// leaves no point out.
constexpr double kRounding = 1e-6;

// Points nearer than this fraction of their mean spacing are checked at every step [1]: a fast body
// travels that far in one or a few steps.
constexpr double kNear = 0.1;

// Path of a point whose nodes have the paths path_of(node).
template <class PathOf>
StepPath mean_path(std::span<const ContactPoints::Share> shares, const PathOf& path_of) {
  StepPath sum;
  for (const ContactPoints::Share& share : shares) {
    const StepPath path = path_of(share.node);
    sum.from += share.weight * path.from;
    sum.to += share.weight * path.to;
  }
  return sum;
}

}  // namespace

NearPoints::NearPoints(const Shared& shared, const FastPaths& paths)
    : shared_(shared), paths_(&paths), views_(shared.obstacles->size()) {
  const ContactPoints& points = *shared_.points;
  double area = 0;
  for (std::uint32_t p = 0; p < points.count(); ++p) {
    reach_ = std::max(reach_, points.reach(p));
    area += points.area(p);
  }
  near_ = kNear * std::sqrt(area / std::max(1U, points.count()));
  for (View& view : views_) view.checked_at.assign(points.count(), 0);
}

void NearPoints::check(const FastStep& step, StepCorrection& solver) {
  for (View& view : views_) view.near.clear();
  if (shared_.points->count() == 0 || views_.empty()) return;
  const Box3 here = bounds(step.after);
  const Box3 swept = bounds_.isEmpty() ? bounds(step.before).merged(here) : bounds_.merged(here);
  bounds_ = here;
  // Corners and contacts may have pressed a point out of these bounds, into an obstacle.
  if (solver.next_contact() == nullptr && !near_anything(swept)) {
    away_ = true;
    return;
  }
  if (away_) arrive();
  add_travel(step);
  for (std::uint32_t o = 0; o < views_.size(); ++o) {
    continue_contacts(step, o, solver);
    if (!region_touching((*shared_.obstacles)[o], swept).isEmpty()) check_points(step, o, solver);
  }
}

// Towards a plane only the displacement along its normal counts, towards a box any.
void NearPoints::add_travel(const FastStep& step) {
  Vec3 local = Vec3::Zero();
  for (std::uint32_t b = 0; b < shared_.body->block_count(); ++b)
    local = local.cwiseMax(shared_.body->largest_displacement(b));
  const Vec3 common = step.after.origin - step.before.origin;
  for (std::size_t o = 0; o < views_.size(); ++o) {
    const auto* plane = std::get_if<Plane>(&(*shared_.obstacles)[o].shape);
    const double travel =
        plane != nullptr ? std::abs(plane->normal.dot(common)) + plane->normal.cwiseAbs().dot(local)
                         : common.norm() + local.norm();
    views_[o].travel += (1 + kRounding) * travel;
  }
}

void NearPoints::corrected(double travel) {
  for (View& view : views_) view.travel += travel;
}

// The distance of a point from the centre of the nodes' box is at most its reach times half the
// size of the box.
Box3 NearPoints::bounds(const MovingFrame& frame) const {
  Box3 nodes;
  for (std::uint32_t b = 0; b < shared_.body->block_count(); ++b)
    nodes.extend(shared_.body->bounds(b));
  const Vec3 half = (1 + kRounding) * reach_ / 2 * nodes.sizes();
  return moved(Box3(nodes.center() - half, nodes.center() + half), frame.origin);
}

bool NearPoints::near_anything(const Box3& swept) const {
  return std::any_of(
      shared_.obstacles->begin(), shared_.obstacles->end(),
      [&](const Obstacle& obstacle) { return !region_touching(obstacle, swept).isEmpty(); });
}

void NearPoints::arrive() {
  away_ = false;
  for (View& view : views_) view.schedule.restart(shared_.points->count(), near_);
}

// The depth of a point in a box counts from the side by which it entered, so a point may be in
// contact and far from the surface.
void NearPoints::continue_contacts(const FastStep& step, std::uint32_t obstacle,
                                   StepCorrection& solver) {
  for (const Contact* next = solver.next_contact(); next != nullptr && next->obstacle == obstacle;
       next = solver.next_contact()) {
    note_check(step, obstacle, next->point);
    solver.continue_contact();
  }
}

void NearPoints::check_points(const FastStep& step, std::uint32_t obstacle,
                              StepCorrection& solver) {
  View& view = views_[obstacle];
  const Obstacle& thing = (*shared_.obstacles)[obstacle];
  const bool is_box = std::holds_alternative<SolidBox>(thing.shape);
  view.schedule.check(view.travel, [&](std::uint32_t point) {
    if (view.checked_at[point] == step.number + 1) return 0.0;  // in contact
    const double distance = surface_distance(thing, point_to(point)).distance;
    if (distance <= 0 || is_box) check_point(step, obstacle, point, solver);
    return distance / shared_.points->reach(point);
  });
}

void NearPoints::check_point(const FastStep& step, std::uint32_t obstacle, std::uint32_t point,
                             StepCorrection& solver) {
  const StepPath path = point_path(point);
  if (views_[obstacle].checked_at[point] != step.number)
    shared_.finder->take_sides(obstacle, point, path.from);
  note_check(step, obstacle, point);
  solver.check_contact(obstacle, point, path);
}

void NearPoints::note_check(const FastStep& step, std::uint32_t obstacle, std::uint32_t point) {
  View& view = views_[obstacle];
  if (std::holds_alternative<SolidBox>((*shared_.obstacles)[obstacle].shape))
    view.near.push_back(point);
  view.checked_at[point] = step.number + 1;
}

void NearPoints::check_walls(const FastStep& step, const StepNodes& nodes) {
  std::size_t wall = 0;
  for (std::size_t o = 0; o < views_.size(); ++o) {
    if (!std::holds_alternative<SolidBox>((*shared_.obstacles)[o].shape)) continue;
    for (const std::uint32_t point : views_[o].near) {
      const StepPath path = corrected_path(point, nodes);
      if (shared_.walls->goes_through(wall, point, path.from, path.to) && !passage_)
        passage_ = Passage{step.number, wall, point, path.from, path.to};
    }
    ++wall;
  }
}

Vec3 NearPoints::point_to(std::uint32_t point) const {
  Vec3 sum = Vec3::Zero();
  for (const ContactPoints::Share& share : shared_.points->shares(point))
    sum += share.weight * paths_->path(share.node).to;
  return sum;
}

StepPath NearPoints::point_path(std::uint32_t point) const {
  return mean_path(shared_.points->shares(point),
                   [&](std::uint32_t node) { return paths_->path(node); });
}

StepPath NearPoints::corrected_path(std::uint32_t point, const StepNodes& nodes) const {
  return mean_path(shared_.points->shares(point), [&](std::uint32_t node) {
    return nodes.has(node) ? nodes.corrected_path(node) : paths_->path(node);
  });
}

}  // namespace springlod::sim
