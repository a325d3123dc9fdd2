#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "model/mass_spring.hpp"
#include "sim/scenario.hpp"

namespace springlod {

/// One node pressed into one obstacle at this instant.
struct Contact {
  std::uint32_t node = 0;
  double depth = 0;                 ///< d [m] > 0
  double stiffness = 0;             ///< kappa A [N/m]
  double normal_force = 0;          ///< kappa A (d + damping * rate of d), cut off at 0 [N]
  double damping_force = 0;         ///< the part of normal_force that is not kappa A d [N]
  double damping = 0;               ///< contact damping time [s]
  double friction = 0;              ///< mu
  Vec3 normal = Vec3::UnitZ();      ///< out of the obstacle
  Vec3 slip_change = Vec3::Zero();  ///< what friction took from the node's velocity [m/s]

  /// Change of normal_force with depth where the rate is that of a step of length dt [N/m].
  double implicit_stiffness(double step) const { return stiffness * (1 + damping / step); }
};

/// Finds which nodes touch the obstacles. It keeps, for every node and box, from which side of each
/// box axis the node came: depth is measured to that side, so a node pressed past the middle of a
/// thin box is pushed back out where it came in and the potential kappa A d^2 / 2 never jumps.
/// (A node that gets from one side of a box to the other within one step is thrown back too, with
/// an energy that no step resolves: boxes must be thicker than speed times step.)
class ContactFinder {
 public:
  /// `x`: the start positions. Obstacles and model must outlive the finder.
  ContactFinder(const MassSpringModel& model, const std::vector<Obstacle>& obstacles,
                const std::vector<Vec3>& x);
  /// Contacts at positions x with velocities v (for contact damping): obstacle by obstacle, nodes
  /// rising.
  void find(const std::vector<Vec3>& x, const std::vector<Vec3>& v, std::vector<Contact>& contacts);

  /// The same for one obstacle and one of nodes().
  std::optional<Contact> find_one(std::size_t obstacle, std::size_t number, const Vec3& x,
                                  const Vec3& v);
  /// For a node that was not looked at on its last steps: it was at x, outside of the obstacle.
  void take_sides(std::size_t obstacle, std::size_t number, const Vec3& x);
  /// Those with an area, rising.
  const std::vector<std::uint32_t>& nodes() const { return node_; }

 private:
  using Sides = std::array<std::int8_t, 3>;  // -1 or 1 along each box axis

  std::optional<Contact> touch_plane(const Obstacle& obstacle, const Plane& plane,
                                     std::size_t number, const Vec3& x, const Vec3& v) const;
  std::optional<Contact> touch_box(const Obstacle& obstacle, const SolidBox& box, Sides& sides,
                                   std::size_t number, const Vec3& x, const Vec3& v) const;

  const std::vector<Obstacle>* obstacles_;
  std::vector<std::uint32_t> node_;        // nodes with an area
  std::vector<double> area_;               // their areas [m2]
  std::vector<std::vector<Sides>> sides_;  // by obstacle; empty for planes
};

void add_normal_forces(const std::vector<Contact>& contacts, std::vector<Vec3>& force);

/// Change of the velocity v of a node by friction over a step: see apply_friction.
Vec3 friction_slip_change(const Contact& contact, double mass, double step, const Vec3& v);

/// Coulomb friction as a cap on slip: takes from the tangential velocity at most
/// mu f_n dt / m and never more than there is, so that no step reverses a slip. `v` are the
/// velocities after all other forces of the step.
void apply_friction(const MassSpringModel& model, double step, std::vector<Contact>& contacts,
                    std::vector<Vec3>& v);

/// Sum of kappa A d^2 / 2 [J].
double contact_energy(const std::vector<Contact>& contacts);

/// What the obstacles may add to the stiffness of each node in one direction at most [N/m]: kappa A
/// summed over the obstacles, where planes at an angle only count by how far they reinforce each
/// other.
std::vector<double> contact_stiffness(const MassSpringModel& model,
                                      const std::vector<Obstacle>& obstacles);

}  // namespace springlod
