#include "sim/contact/tunnel_watch.hpp"

#include <cmath>
#include <cstdlib>

#include <fmt/format.h>

#include "base/error.hpp"

namespace springlod::sim {
namespace {

std::int8_t face(Eigen::Index axis, bool positive) {
  const auto number = static_cast<std::int8_t>(axis + 1);
  return positive ? number : static_cast<std::int8_t>(-number);
}

/// The face nearest to a point inside; 0 outside.
std::int8_t nearest_face(const Vec3& half_size, const Vec3& at) {
  Eigen::Index axis = 0;
  const double depth = (half_size - at.cwiseAbs()).minCoeff(&axis);
  return depth > 0 ? face(axis, at[axis] >= 0) : std::int8_t{0};
}

}  // namespace

TunnelCheck::TunnelCheck(const ContactPoints& points, const std::vector<Obstacle>& obstacles,
                         const std::vector<Vec3>& x)
    : points_(&points) {
  for (const Obstacle& obstacle : obstacles) {
    const auto* box = std::get_if<SolidBox>(&obstacle.shape);
    if (box == nullptr) continue;
    Wall& wall = walls_.emplace_back(Wall{obstacle.name, *box, {}});
    for (std::uint32_t p = 0; p < points.count(); ++p)
      wall.entry.push_back(nearest_face(box->half_size, box->local(points.interpolate(p, x))));
  }
  if (walls_.empty()) return;
  for (std::uint32_t p = 0; p < points.count(); ++p) at_.push_back(points.interpolate(p, x));
}

void TunnelCheck::check(const std::vector<Vec3>& x, double time, double step) {
  for (std::size_t w = 0; w < walls_.size(); ++w)
    for (std::size_t p = 0; p < at_.size(); ++p)
      if (goes_through(w, p, at_[p], points_->interpolate(p, x)))
        throw_tunnelled(w, p, at_[p], points_->interpolate(p, x), time, step);
  for (std::size_t p = 0; p < at_.size(); ++p) at_[p] = points_->interpolate(p, x);
}

bool TunnelCheck::goes_through(std::size_t wall, std::size_t point, const Vec3& from,
                               const Vec3& to) {
  const SolidBox& box = walls_[wall].box;
  Face& entry = walls_[wall].entry[point];
  const Pass crossing = pass(box.half_size, box.local(from), box.local(to));
  if (!crossing.hits) {
    entry = 0;
    return false;
  }
  if (crossing.in != 0) entry = crossing.in;
  if (crossing.out == 0) return false;
  const bool through = crossing.out == -entry;
  if (!through) entry = 0;
  return through;
}

// Clips the segment between `from` and `to` by the three pairs of faces in turn.
TunnelCheck::Pass TunnelCheck::pass(const Vec3& half_size, const Vec3& from, const Vec3& to) {
  Pass pass;
  double begin = 0;
  double end = 1;
  for (Eigen::Index axis = 0; axis < 3; ++axis) {
    const double half = half_size[axis];
    if ((from[axis] >= half && to[axis] >= half) || (from[axis] <= -half && to[axis] <= -half))
      return {};
    const double displacement = to[axis] - from[axis];
    if (displacement == 0) continue;  // parallel to this pair of faces, between them
    const double forward = displacement > 0 ? 1 : -1;
    const double enters = (-forward * half - from[axis]) / displacement;
    const double leaves = (forward * half - from[axis]) / displacement;
    if (enters > begin) {
      begin = enters;
      pass.in = face(axis, displacement < 0);
    }
    if (leaves < end) {
      end = leaves;
      pass.out = face(axis, displacement > 0);
    }
  }
  pass.hits = begin < end;
  return pass;
}

void TunnelCheck::throw_tunnelled(std::size_t wall, std::size_t point, const Vec3& from,
                                  const Vec3& to, double time, double step) const {
  const SolidBox& box = walls_[wall].box;
  const Vec3 start = box.local(from);
  const Vec3 end = box.local(to);
  const Eigen::Index axis = std::abs(pass(box.half_size, start, end).out) - 1;
  const double thickness = 2 * box.half_size[axis];
  const double moved = std::abs(end[axis] - start[axis]);
  std::string advice =
      "its contact is too soft to hold the body: give it more stiffness, or make it thicker";
  // Such a step does not resolve the contact.
  if (moved > thickness / 2)
    advice += fmt::format(", or take a step below {:.3g} s", step * thickness / (2 * moved));
  throw TunnelError(
      fmt::format("{} went through obstacle \"{}\" by t = {:.6g} s: it moved {:.3g} m in a "
                  "step of {:.3g} s, and the obstacle is {:.3g} m thick; {}",
                  points_->name(point), walls_[wall].name, time, moved, step, thickness, advice),
      points_->number(point), walls_[wall].name, time);
}

}  // namespace springlod::sim
