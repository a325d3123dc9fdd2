#include "sim/contact.hpp"

#include <algorithm>
#include <cmath>

#include <Eigen/Eigenvalues>

namespace springlod {
namespace {

std::int8_t side_of(double coordinate) {
  return coordinate < 0 ? -1 : 1;
}

Contact make_contact(const Obstacle& obstacle, std::uint32_t node, double area, double depth,
                     const Vec3& normal, const Vec3& velocity) {
  Contact contact;
  contact.node = node;
  contact.depth = depth;
  contact.stiffness = obstacle.stiffness * area;
  contact.damping = obstacle.damping;
  contact.friction = obstacle.friction;
  contact.normal = normal;
  const double elastic = contact.stiffness * depth;
  const double rate = -normal.dot(velocity);
  contact.normal_force =
      std::max(0.0, elastic + contact.stiffness * obstacle.damping * rate);  // never pulling
  contact.damping_force = contact.normal_force - elastic;
  return contact;
}

}  // namespace

ContactFinder::ContactFinder(const MassSpringModel& model, const std::vector<Obstacle>& obstacles,
                             const std::vector<Vec3>& x)
    : obstacles_(&obstacles), sides_(obstacles.size()) {
  for (std::uint32_t i = 0; i < model.node_count(); ++i)
    if (model.contact_area[i] > 0) {
      node_.push_back(i);
      area_.push_back(model.contact_area[i]);
    }
  for (std::size_t o = 0; o < obstacles.size(); ++o) {
    if (!std::holds_alternative<SolidBox>(obstacles[o].shape)) continue;
    sides_[o].resize(node_.size());
    for (std::size_t n = 0; n < node_.size(); ++n) take_sides(o, n, x[node_[n]]);
  }
}

void ContactFinder::take_sides(std::size_t obstacle, std::size_t number, const Vec3& x) {
  const auto* box = std::get_if<SolidBox>(&(*obstacles_)[obstacle].shape);
  if (box == nullptr) return;
  const Vec3 local = box->local(x);
  sides_[obstacle][number] = {side_of(local[0]), side_of(local[1]), side_of(local[2])};
}

void ContactFinder::find(const std::vector<Vec3>& x, const std::vector<Vec3>& v,
                         std::vector<Contact>& contacts) {
  contacts.clear();
  for (std::size_t o = 0; o < obstacles_->size(); ++o)
    for (std::size_t n = 0; n < node_.size(); ++n)
      if (const auto contact = find_one(o, n, x[node_[n]], v[node_[n]]))
        contacts.push_back(*contact);
}

std::optional<Contact> ContactFinder::find_one(std::size_t obstacle, std::size_t number,
                                               const Vec3& x, const Vec3& v) {
  const Obstacle& thing = (*obstacles_)[obstacle];
  if (const auto* plane = std::get_if<Plane>(&thing.shape))
    return touch_plane(thing, *plane, number, x, v);
  return touch_box(thing, std::get<SolidBox>(thing.shape), sides_[obstacle][number], number, x, v);
}

std::optional<Contact> ContactFinder::touch_plane(const Obstacle& obstacle, const Plane& plane,
                                                  std::size_t number, const Vec3& x,
                                                  const Vec3& v) const {
  const double depth = plane.offset - plane.normal.dot(x);
  if (!(depth > 0)) return std::nullopt;
  return make_contact(obstacle, node_[number], area_[number], depth, plane.normal, v);
}

std::optional<Contact> ContactFinder::touch_box(const Obstacle& obstacle, const SolidBox& box,
                                                Sides& side, std::size_t number, const Vec3& x,
                                                const Vec3& v) const {
  const Vec3 local = box.local(x);
  Eigen::Index axis = 0;
  const double depth =
      (box.half_size - Vec3(side[0] * local[0], side[1] * local[1], side[2] * local[2]))
          .minCoeff(&axis);
  for (Eigen::Index i = 0; i < 3; ++i) {
    // Another side may be taken wherever that leaves the depth as it is: outside, and along the
    // axes that do not decide.
    const bool free_to_change = depth <= 0 || box.half_size[i] - std::abs(local[i]) >= depth;
    if (free_to_change) side[static_cast<std::size_t>(i)] = side_of(local[i]);
  }
  if (!(depth > 0)) return std::nullopt;
  const Vec3 normal = side[static_cast<std::size_t>(axis)] * box.rotation.col(axis);
  return make_contact(obstacle, node_[number], area_[number], depth, normal, v);
}

void add_normal_forces(const std::vector<Contact>& contacts, std::vector<Vec3>& force) {
  for (const Contact& c : contacts) force[c.node] += c.normal_force * c.normal;
}

Vec3 friction_slip_change(const Contact& contact, double mass, double step, const Vec3& v) {
  const Vec3 slip = v - contact.normal.dot(v) * contact.normal;
  const double speed = slip.norm();
  const double most = contact.friction * contact.normal_force * step / mass;
  return most < speed ? Vec3(slip * (-most / speed)) : Vec3(-slip);
}

void apply_friction(const MassSpringModel& model, double step, std::vector<Contact>& contacts,
                    std::vector<Vec3>& v) {
  for (Contact& c : contacts) {
    c.slip_change = friction_slip_change(c, model.mass[c.node], step, v[c.node]);
    v[c.node] += c.slip_change;
  }
}

double contact_energy(const std::vector<Contact>& contacts) {
  double energy = 0;
  for (const Contact& c : contacts) energy += 0.5 * c.stiffness * c.depth * c.depth;
  return energy;
}

std::vector<double> contact_stiffness(const MassSpringModel& model,
                                      const std::vector<Obstacle>& obstacles) {
  Mat3 planes = Mat3::Zero();  // sum of kappa n n^T
  double boxes = 0;            // a box may push along any of its axes
  for (const Obstacle& obstacle : obstacles) {
    if (const auto* plane = std::get_if<Plane>(&obstacle.shape))
      planes += obstacle.stiffness * plane->normal * plane->normal.transpose();
    else
      boxes += obstacle.stiffness;
  }
  const double kappa =
      boxes + Eigen::SelfAdjointEigenSolver<Mat3>(planes, Eigen::EigenvaluesOnly).eigenvalues()[2];
  std::vector<double> stiffness(model.node_count());
  for (std::uint32_t i = 0; i < model.node_count(); ++i)
    stiffness[i] = kappa * model.contact_area[i];
  return stiffness;
}

}  // namespace springlod
