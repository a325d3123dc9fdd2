#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "sim/contact/contact_points.hpp"
#include "sim/scenario.hpp"

namespace springlod::sim {

/// One point of the body pressed into one obstacle at this instant.
struct Contact {
  std::uint32_t obstacle = 0;       ///< of the scenario
  std::uint32_t point = 0;          ///< as ContactPoints counts them
  double depth = 0;                 ///< d [m] > 0
  double stiffness = 0;             ///< k = ContactPoints::stiffness, of a node kappa A [N/m]
  double normal_force = 0;          ///< k (d + damping * rate of d), cut off at 0 [N]
  double damping_force = 0;         ///< the part of normal_force that is not k d [N]
  double damping = 0;               ///< contact damping time [s]
  double friction = 0;              ///< mu
  Vec3 normal = Vec3::UnitZ();      ///< out of the obstacle
  Vec3 slip_change = Vec3::Zero();  ///< what friction took from the point's velocity [m/s]

  /// A point that gives way is held by friction through a spring along the obstacle, the grip, as
  /// stiff as 1 / ContactPoints::give [N/m]; 0: friction holds the point itself.
  double grip = 0;
  double grip_damping = 0;      ///< c / k of the grip [s]
  Vec3 stretch = Vec3::Zero();  ///< of the grip, which pulls the point against it [m]
  double grip_gain = 0;         ///< what the grip took in this step [J]
  double grip_energy() const { return 0.5 * grip * stretch.squaredNorm(); }  ///< [J]

  /// Change of normal_force with depth where the rate is that of a step of length dt [N/m].
  double implicit_stiffness(double step) const { return stiffness * (1 + damping / step); }
};

/// Finds which points touch the obstacles. It keeps, for every point and box, from which side of
/// each box axis the point came: depth is measured to that side, so a point pressed past the middle
/// of a thin box is pushed back out where it came in and the potential kappa A d^2 / 2 never jumps.
/// (A point that gets from one side of a box to the other within one step is thrown back too, with
/// an energy that no step resolves: boxes must be thicker than speed times step.)
class ContactFinder {
 public:
  /// `x`: the start positions of the nodes. Points and obstacles must outlive the finder.
  ContactFinder(const ContactPoints& points, const std::vector<Obstacle>& obstacles,
                const std::vector<Vec3>& x);
  /// Contacts with nodes at x with velocities v (for contact damping): obstacle by obstacle, points
  /// rising.
  void find(const std::vector<Vec3>& x, const std::vector<Vec3>& v, std::vector<Contact>& contacts);

  /// The same for one obstacle and one point at x.
  std::optional<Contact> find_one(std::size_t obstacle, std::uint32_t point, const Vec3& x,
                                  const Vec3& v);
  /// For a point that was not looked at on its last steps: it was at x, outside of the obstacle.
  void take_sides(std::size_t obstacle, std::uint32_t point, const Vec3& x);

 private:
  using Sides = std::array<std::int8_t, 3>;  // -1 or 1 along each box axis

  const ContactPoints* points_;
  const std::vector<Obstacle>* obstacles_;
  std::vector<std::vector<Sides>> sides_;  // by obstacle; empty for planes
};

void add_normal_forces(const ContactPoints& points, const std::vector<Contact>& contacts,
                       std::vector<Vec3>& force);

/// Points that touch the same obstacle as they did a step before keep the stretch of their grip;
/// others start with none. Both as ContactFinder lists them.
void keep_grips(const std::vector<Contact>& before, std::vector<Contact>& now);

/// Friction over a step on a point of velocity v and mass m: its slip_change, and stretch and
/// grip_gain of its grip by the end of the step. Without a grip, it takes from the tangential
/// velocity at most mu f_n dt / m and never more than there is, so that no step reverses a slip.
/// With one, the spring is stretched by the slip and pulls, to the end of the step (implicit, so
/// that no stiffness is too much for a step), and slides where it pulls more than mu f_n: spring
/// and slider in a row (Cundall and Strack 1979, "A discrete numerical model for granular
/// assemblies").
void rub(Contact& contact, double mass, double step, const Vec3& v);

/// Coulomb friction on all contacts: see rub. `v` are the velocities of the nodes after all other
/// forces of the step. Contact after contact, for points may share nodes. Returns the kinetic
/// energy that it took [J], that which the grips keep included.
double apply_friction(const ContactPoints& points, double step, std::vector<Contact>& contacts,
                      std::vector<Vec3>& v);

/// Sum of k d^2 / 2, and what the grips hold [J].
double contact_energy(const std::vector<Contact>& contacts);

/// What the obstacles may add to the stiffness of each node in one direction at most [N/m]: k
/// summed over the obstacles, where planes at an angle only count by how far they reinforce each
/// other. Points that several nodes carry join these; the sum |w_i| sum |w_j| k over the
/// points of a node bounds that, for (sum w_j x_j)^2 <= sum |w_j| sum |w_j| x_j^2.
std::vector<double> contact_stiffness(const ContactPoints& points,
                                      const std::vector<Obstacle>& obstacles);

}  // namespace springlod::sim
