#include "sim/contact/contact.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace springlod::sim {
namespace {

std::int8_t side_of(double coordinate) {
  return coordinate < 0 ? -1 : 1;
}

std::optional<Penetration> depth_in(const Plane& plane, const Vec3& x) {
  const double depth = plane.offset - plane.normal.dot(x);
  if (!(depth > 0)) return std::nullopt;
  return Penetration{depth, plane.normal};
}

std::optional<Penetration> depth_in(const SolidBox& box, std::array<std::int8_t, 3>& side,
                                    const Vec3& x) {
  const Vec3 local = box.local(x);
  Eigen::Index axis = 0;
  const double depth =
      (box.half_size - Vec3(side[0] * local[0], side[1] * local[1], side[2] * local[2]))
          .minCoeff(&axis);
  for (Eigen::Index i = 0; i < 3; ++i) {
    // The side may change where this does not change the depth: outside, and along the axes that
    // do not determine it.
    const bool free_to_change = depth <= 0 || box.half_size[i] - std::abs(local[i]) >= depth;
    if (free_to_change) side[static_cast<std::size_t>(i)] = side_of(local[i]);
  }
  if (!(depth > 0)) return std::nullopt;
  return Penetration{depth, side[static_cast<std::size_t>(axis)] * box.rotation.col(axis)};
}

}  // namespace

ContactFinder::ContactFinder(const ContactPoints& points, const std::vector<Obstacle>& obstacles,
                             const std::vector<Vec3>& x)
    : points_(&points), obstacles_(&obstacles), sides_(obstacles.size()) {
  for (std::size_t o = 0; o < obstacles.size(); ++o) {
    if (!std::holds_alternative<SolidBox>(obstacles[o].shape)) continue;
    sides_[o].resize(points.count());
    for (std::uint32_t p = 0; p < points.count(); ++p) take_sides(o, p, points.interpolate(p, x));
  }
}

void ContactFinder::take_sides(std::size_t obstacle, std::uint32_t point, const Vec3& x) {
  const auto* box = std::get_if<SolidBox>(&(*obstacles_)[obstacle].shape);
  if (box == nullptr) return;
  const Vec3 local = box->local(x);
  sides_[obstacle][point] = {side_of(local[0]), side_of(local[1]), side_of(local[2])};
}

void ContactFinder::find(const std::vector<Vec3>& x, const std::vector<Vec3>& v,
                         const std::vector<Vec3>& frames, std::vector<Contact>& contacts) {
  const auto position = [&](std::uint32_t node) -> const Vec3& { return frames[node]; };
  contacts.clear();
  for (std::size_t o = 0; o < obstacles_->size(); ++o)
    for (std::uint32_t p = 0; p < points_->count(); ++p) {
      const std::optional<Penetration> at = penetration(o, p, points_->interpolate(p, x));
      if (!at) continue;
      Contact& found =
          contacts.emplace_back(contact(o, p, at->normal, points_->frame(p, position)));
      found.depth = at->depth;
      const double elastic = found.stiffness * found.depth;
      const double rate = -found.normal.dot(points_->interpolate(p, v));
      found.normal_force =
          std::max(0.0, elastic + found.stiffness * found.damping * rate);  // contact never pulls
      found.damping_force = found.normal_force - elastic;
    }
}

std::optional<Penetration> ContactFinder::penetration(std::size_t obstacle, std::uint32_t point,
                                                      const Vec3& x) {
  const Obstacle& thing = (*obstacles_)[obstacle];
  const auto* plane = std::get_if<Plane>(&thing.shape);
  return plane != nullptr ? depth_in(*plane, x)
                          : depth_in(std::get<SolidBox>(thing.shape), sides_[obstacle][point], x);
}

std::optional<Penetration> ContactFinder::entry(std::size_t obstacle, std::uint32_t point,
                                                const StepPath& path) {
  std::optional<Penetration> end = penetration(obstacle, point, path.to);
  const auto* box = std::get_if<SolidBox>(&(*obstacles_)[obstacle].shape);
  if (!end || box == nullptr) return end;
  const Vec3 from = box->local(path.from);
  const Vec3 to = box->local(path.to);
  double last = 0;  // fraction of the path that lies before the face
  for (Eigen::Index i = 0; i < 3; ++i) {
    const std::int8_t side = side_of(from[i]);
    const double before = side * from[i] - box->half_size[i];
    const double depth = box->half_size[i] - side * to[i];
    if (!(before > 0) || !(before > last * (before + depth))) continue;
    last = before / (before + depth);
    end = Penetration{depth, side * box->rotation.col(i)};
    sides_[obstacle][point][static_cast<std::size_t>(i)] = side;
  }
  return end;
}

Contact ContactFinder::contact(std::size_t obstacle, std::uint32_t point, const Vec3& normal,
                               const Mat3& frame) const {
  const Obstacle& thing = (*obstacles_)[obstacle];
  const ContactPoints::Yielding yielding = points_->yielding(point, normal, frame);
  Contact contact;
  contact.obstacle = static_cast<std::uint32_t>(obstacle);
  contact.point = point;
  contact.stiffness = points_->stiffness(point, thing, yielding.normal);
  contact.damping = points_->damping(point, thing, yielding.normal);
  contact.friction = thing.friction;
  contact.normal = normal;
  if (yielding.tangential > 0) contact.stick_stiffness = 1 / yielding.tangential;
  contact.sideways = yielding.sideways;
  contact.stick_damping = points_->compliance_damping(point);
  return contact;
}

void Contact::continue_from(const Contact& before) {
  const Vec3 yield_before = before.yield;
  yield = before.normal_force * sideways;
  stretch = before.stretch;
  if (friction > 0) stretch += yield - yield_before;
}

void keep_stick_springs(const std::vector<Contact>& before, std::vector<Contact>& now) {
  const auto place = [](const Contact& c) { return std::pair(c.obstacle, c.point); };
  auto was = before.begin();
  for (Contact& c : now) {
    while (was != before.end() && place(*was) < place(c)) ++was;
    if (was == before.end()) return;
    if (place(*was) == place(c)) c.continue_from(*was);
  }
}

FrictionLaw::FrictionLaw(const Contact& contact, double mass, double step)
    : normal_(padded(contact.normal)), inverse_mass_(1 / mass) {
  if (contact.stick_stiffness == 0) return;
  stick_ = contact.stick_stiffness;
  damping_ = contact.stick_damping;
  late_ = step + damping_;
  const double pull = stick_ * step * inverse_mass_;
  gain_ = pull / (1 + pull * late_);
  inverse_late_ = 1 / late_;
  stretch_ = 1 / (stick_ * inverse_mass_);
  start(contact);
}

void apply_friction(Contact& contact, double mass, double step, const Vec3& v) {
  const FrictionLaw law(contact, mass, step);
  contact.slip_change =
      law.slip_change(padded(v), contact.friction * contact.normal_force * step).head<3>();
  law.finish(contact);
}

double apply_friction(const ContactPoints& points, double step, std::vector<Contact>& contacts,
                      std::vector<Vec3>& v) {
  double taken = 0;
  for (Contact& c : contacts) {
    const double mass = points.mass(c.point);
    const Vec3 before = points.interpolate(c.point, v);
    apply_friction(c, mass, step, before);
    points.kick(c.point, c.slip_change, v);
    taken -= mass * c.slip_change.dot(before + 0.5 * c.slip_change);
  }
  return taken;
}

double contact_energy(const std::vector<Contact>& contacts) {
  double energy = 0;
  for (const Contact& c : contacts) energy += c.energy();
  return energy;
}

}  // namespace springlod::sim
