#include "sim/fast/skin_contacts.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "sim/fast/regions.hpp"

namespace springlod::sim {
namespace {

// Bounds and displacements are widened by this fraction [1], so that rounding to single precision
// leaves no point out.
constexpr double kRounding = 1e-6;

// Points nearer than this fraction of their mean spacing are checked at every step [1]: a fast body
// travels that far in one or a few steps.
constexpr double kNear = 0.1;

}  // namespace

SkinContacts::SkinContacts(const Shared& shared)
    : FastContacts(shared, shared.model->node_count()),
      numbers_(points().count()),
      views_(obstacles().size()),
      to_(model().node_count()),
      to_of_(model().node_count(), 0) {
  std::iota(numbers_.begin(), numbers_.end(), 0U);
  double area = 0;
  for (const std::uint32_t p : numbers_) {
    reach_ = std::max(reach_, points().reach(p));
    area += points().area(p);
  }
  near_ = kNear * std::sqrt(area / std::max(1U, points().count()));
  for (View& view : views_) {
    view.checked_at.assign(points().count(), 0);
    view.before.assign(points().count(), kNone);
  }
}

void SkinContacts::correct(const Step& step) {
  const Box3 here = bounds(step.after);
  const Box3 swept = bounds_.isEmpty() ? bounds(step.before).merged(here) : bounds_.merged(here);
  bounds_ = here;
  solver().begin(step.length);
  if (!near_anything(swept)) {
    away_ = true;
    return;
  }
  if (away_) arrive();
  add_travel(step);
  const bool at_wall = near_wall(swept);
  if (at_wall) {
    from_.clear();
    for (const std::uint32_t p : numbers_) from_.push_back(point_from(step, p));
  }
  for (std::uint32_t o = 0; o < obstacles().size(); ++o)
    if (!region_touching(obstacles()[o], swept).isEmpty()) check_points(step, o);
  solve_contacts(step);
  if (at_wall)
    check_walls(step.number, numbers_, [&](std::uint32_t point) {
      return StepContacts::Path{from_[point], point_to(step, point)};
    });
}

// Towards a plane only the displacement along its normal counts, towards a box any.
void SkinContacts::add_travel(const Step& step) {
  Vec3 local = Vec3::Zero();
  for (std::uint32_t b = 0; b < body().block_count(); ++b)
    local = local.cwiseMax(body().largest_displacement(b));
  const Vec3 common = step.after.origin - step.before.origin;
  for (std::size_t o = 0; o < views_.size(); ++o) {
    const auto* plane = std::get_if<Plane>(&obstacles()[o].shape);
    const double travel =
        plane != nullptr ? std::abs(plane->normal.dot(common)) + plane->normal.cwiseAbs().dot(local)
                         : common.norm() + local.norm();
    views_[o].travel += (1 + kRounding) * travel;
  }
}

void SkinContacts::solve_contacts(const Step& step) {
  solve(
      step,
      [&](std::uint32_t node) {
        return StepContacts::Path{node_from(step, node), node_to(step, node)};
      },
      [](std::uint32_t node) { return node; });
  double most = 0;
  for (const NodeChange& change : changes()) {
    most = std::max(most, change.displacement.squaredNorm());
    to_[change.node] += change.displacement;
  }
  for (View& view : views_) view.travel += std::sqrt(most);
}

// The distance of a point from the centre of the nodes' box is at most its reach times half the
// size of the box.
Box3 SkinContacts::bounds(const MovingFrame& frame) const {
  Box3 nodes;
  for (std::uint32_t b = 0; b < body().block_count(); ++b) nodes.extend(body().bounds(b));
  const Vec3 half = (1 + kRounding) * reach_ / 2 * nodes.sizes();
  return moved(Box3(nodes.center() - half, nodes.center() + half), frame.origin);
}

bool SkinContacts::near_anything(const Box3& swept) const {
  return std::any_of(obstacles().begin(), obstacles().end(), [&](const Obstacle& obstacle) {
    return !region_touching(obstacle, swept).isEmpty();
  });
}

void SkinContacts::arrive() {
  away_ = false;
  for (View& view : views_) view.schedule.restart(points().count(), near_);
}

void SkinContacts::check_points(const Step& step, std::uint32_t obstacle) {
  View& view = views_[obstacle];
  const std::vector<Contact>& before = solver().before();
  for (std::uint32_t i = 0; i < before.size(); ++i)
    if (before[i].obstacle == obstacle) view.before[before[i].point] = i;
  view.schedule.check(view.travel,
                      [&](std::uint32_t point) { return check_point(step, obstacle, point); });
}

double SkinContacts::check_point(const Step& step, std::uint32_t obstacle, std::uint32_t point) {
  View& view = views_[obstacle];
  const Obstacle& thing = obstacles()[obstacle];
  const Vec3 to = point_to(step, point);
  const double distance = surface_distance(thing, to).distance;
  std::uint32_t& before = view.before[point];
  const bool is_box = std::holds_alternative<SolidBox>(thing.shape);
  if (distance > 0 && before == kNone && !is_box) return distance / points().reach(point);

  const StepContacts::Path path{point_from(step, point), to};
  if (view.checked_at[point] != step.number) finder().take_sides(obstacle, point, path.from);
  view.checked_at[point] = step.number + 1;
  const Contact* was = before == kNone ? nullptr : &solver().before()[before];
  before = kNone;
  solver().check(obstacle, point, was, path);
  return distance / points().reach(point);
}

const Vec3& SkinContacts::node_to(const Step& step, std::uint32_t node) {
  if (to_of_[node] != step.number) {
    to_of_[node] = step.number;
    to_[node] = step.after.origin + body().x(body().place(node));
  }
  return to_[node];
}

Vec3 SkinContacts::node_from(const Step& step, std::uint32_t node) {
  const Vec3 v = step.after.velocity + body().v(body().place(node));
  return node_to(step, node) - step.length * v;
}

Vec3 SkinContacts::point_to(const Step& step, std::uint32_t point) {
  Vec3 sum = Vec3::Zero();
  for (const ContactPoints::Share& share : points().shares(point))
    sum += share.weight * node_to(step, share.node);
  return sum;
}

Vec3 SkinContacts::point_from(const Step& step, std::uint32_t point) {
  Vec3 sum = Vec3::Zero();
  for (const ContactPoints::Share& share : points().shares(point))
    sum += share.weight * node_from(step, share.node);
  return sum;
}

}  // namespace springlod::sim
