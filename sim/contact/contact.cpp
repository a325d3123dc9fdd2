#include "sim/contact/contact.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include <Eigen/Eigenvalues>

namespace springlod::sim {
namespace {

std::int8_t side_of(double coordinate) {
  return coordinate < 0 ? -1 : 1;
}

/// Penetration of a point into an obstacle.
struct Depth {
  double depth = 0;  // [m]
  Vec3 normal = Vec3::UnitZ();
};

std::optional<Depth> depth_in(const Plane& plane, const Vec3& x) {
  const double depth = plane.offset - plane.normal.dot(x);
  if (!(depth > 0)) return std::nullopt;
  return Depth{depth, plane.normal};
}

std::optional<Depth> depth_in(const SolidBox& box, std::array<std::int8_t, 3>& side,
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
  return Depth{depth, side[static_cast<std::size_t>(axis)] * box.rotation.col(axis)};
}

// Upper bound of the stiffness that all obstacles add to a point in one direction [N/m].
double stiffness_of_point(const ContactPoints& points, std::uint32_t point,
                          const std::vector<Obstacle>& obstacles) {
  Mat3 planes = Mat3::Zero();  // sum of k n n^T
  double boxes = 0;            // a box may push along any of its axes
  for (const Obstacle& obstacle : obstacles) {
    const double stiffness = points.stiffness(point, obstacle.stiffness);
    if (const auto* plane = std::get_if<Plane>(&obstacle.shape))
      planes += stiffness * plane->normal * plane->normal.transpose();
    else
      boxes += stiffness;
  }
  return boxes +
         Eigen::SelfAdjointEigenSolver<Mat3>(planes, Eigen::EigenvaluesOnly).eigenvalues()[2];
}

Contact make_contact(const Obstacle& obstacle, const ContactPoints& points, std::uint32_t point,
                     const Depth& at, const Vec3& velocity) {
  Contact contact;
  contact.point = point;
  if (points.compliance(point) > 0) contact.stick_stiffness = 1 / points.compliance(point);
  contact.stick_damping = points.compliance_damping(point);
  contact.depth = at.depth;
  contact.stiffness = points.stiffness(point, obstacle.stiffness);
  contact.damping = points.damping(point, obstacle.stiffness, obstacle.damping);
  contact.friction = obstacle.friction;
  contact.normal = at.normal;
  const double elastic = contact.stiffness * at.depth;
  const double rate = -at.normal.dot(velocity);
  contact.normal_force =
      std::max(0.0, elastic + contact.stiffness * contact.damping * rate);  // contact never pulls
  contact.damping_force = contact.normal_force - elastic;
  return contact;
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
                         std::vector<Contact>& contacts) {
  contacts.clear();
  for (std::size_t o = 0; o < obstacles_->size(); ++o)
    for (std::uint32_t p = 0; p < points_->count(); ++p)
      if (const auto contact =
              find_one(o, p, points_->interpolate(p, x), points_->interpolate(p, v)))
        contacts.push_back(*contact);
}

std::optional<Contact> ContactFinder::find_one(std::size_t obstacle, std::uint32_t point,
                                               const Vec3& x, const Vec3& v) {
  const Obstacle& thing = (*obstacles_)[obstacle];
  const auto* plane = std::get_if<Plane>(&thing.shape);
  const std::optional<Depth> depth =
      plane != nullptr ? depth_in(*plane, x)
                       : depth_in(std::get<SolidBox>(thing.shape), sides_[obstacle][point], x);
  if (!depth) return std::nullopt;
  Contact contact = make_contact(thing, *points_, point, *depth, v);
  contact.obstacle = static_cast<std::uint32_t>(obstacle);
  return contact;
}

void add_normal_forces(const ContactPoints& points, const std::vector<Contact>& contacts,
                       std::vector<Vec3>& force) {
  for (const Contact& c : contacts) points.add_force(c.point, c.normal_force * c.normal, force);
}

void keep_stick_springs(const std::vector<Contact>& before, std::vector<Contact>& now) {
  const auto place = [](const Contact& c) { return std::pair(c.obstacle, c.point); };
  auto was = before.begin();
  for (Contact& c : now) {
    while (was != before.end() && place(*was) < place(c)) ++was;
    if (was == before.end()) return;
    if (place(*was) == place(c)) c.stretch = was->stretch;
  }
}

void apply_friction(Contact& contact, double mass, double step, const Vec3& v) {
  const auto along_face = [&](const Vec3& u) {
    return Vec3(u - contact.normal.dot(u) * contact.normal);
  };
  const auto at_most = [](const Vec3& u, double most) {
    const double size = u.norm();
    return size > most ? Vec3(u * (most / size)) : u;
  };
  const Vec3 slip = along_face(v);
  const double most = contact.friction * contact.normal_force * step;  // [N s]
  if (contact.stick_stiffness == 0) {
    contact.slip_change = at_most(-slip, most / mass);
    return;
  }
  const double held = contact.stick_energy();
  const double late = step + contact.stick_damping;
  const Vec3 start = along_face(contact.stretch);
  const Vec3 impulse = at_most(contact.stick_stiffness * step * (start + late * slip) /
                                   (1 + contact.stick_stiffness * step * late / mass),
                               most);
  contact.slip_change = -impulse / mass;
  contact.stretch = (impulse / contact.stick_stiffness + contact.stick_damping * start) / late;
  contact.stick_gain = contact.stick_energy() - held;
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
  for (const Contact& c : contacts)
    energy += 0.5 * c.stiffness * c.depth * c.depth + c.stick_energy();
  return energy;
}

std::vector<double> contact_stiffness(const ContactPoints& points,
                                      const std::vector<Obstacle>& obstacles) {
  std::vector<double> stiffness(points.node_count(), 0.0);
  for (std::uint32_t p = 0; p < points.count(); ++p) {
    const double most = points.reach(p) * stiffness_of_point(points, p, obstacles);
    for (const ContactPoints::Share& share : points.shares(p))
      stiffness[share.node] += std::abs(share.weight) * most;
  }
  return stiffness;
}

}  // namespace springlod::sim
