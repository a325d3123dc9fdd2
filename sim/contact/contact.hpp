#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <optional>
#include <vector>

#include "sim/contact/contact_points.hpp"
#include "sim/contact/normal_law.hpp"
#include "sim/correction/padded.hpp"
#include "sim/correction/step_nodes.hpp"
#include "sim/scenario.hpp"

namespace springlod::sim {

/// One point of the body in contact with one obstacle at this instant: section 9 of docs/method.md.
struct Contact {
  std::uint32_t obstacle = 0;       ///< number in the scenario
  std::uint32_t point = 0;          ///< number in ContactPoints
  double depth = 0;                 ///< d [m] > 0
  double stiffness = 0;             ///< k = ContactPoints::stiffness; kappa A for a node [N/m]
  double normal_force = 0;          ///< k (d + damping * rate of d), cut off at 0 [N]
  double damping_force = 0;         ///< damping component of normal_force, normal_force - k d [N]
  double damping = 0;               ///< contact damping time [s]
  double friction = 0;              ///< mu
  Vec3 normal = Vec3::UnitZ();      ///< outward normal of the obstacle
  Vec3 slip_change = Vec3::Zero();  ///< change of the point's velocity by friction [m/s]

  /// Stiffness of the tangential contact spring (stick spring), 1 / Yielding::tangential [N/m]; 0:
  /// friction acts on the point directly.
  double stick_stiffness = 0;
  double stick_damping = 0;      ///< damping time of the stick spring [s]
  Vec3 stretch = Vec3::Zero();   ///< stretch of the stick spring; its force is opposite [m]
  double stick_gain = 0;         ///< energy that the stick spring stored in this step [J]
  Vec3 sideways = Vec3::Zero();  ///< see ContactPoints::Yielding [m/N]
  /// Displacement of the surface along the face by the normal force of the last step [m].
  Vec3 yield = Vec3::Zero();
  /// Continues the contact of the same point with the same obstacle in the last step, which may be
  /// this one: takes over the stretch of the stick spring, whose anchor the yield moves.
  void continue_from(const Contact& before);
  double energy() const { return penalty_energy(stiffness, depth) + stick_energy(); }    ///< [J]
  double stick_energy() const { return 0.5 * stick_stiffness * stretch.squaredNorm(); }  ///< [J]

  /// Derivative of normal_force with respect to depth, if the depth grows over a step of length dt
  /// [N/m].
  double implicit_stiffness(double step) const { return stiffness * (1 + damping / step); }
};

/// Penetration of a point into an obstacle.
struct Penetration {
  double depth = 0;             ///< [m] > 0
  Vec3 normal = Vec3::UnitZ();  ///< outward normal of the face that pushes the point out
};

/// Finds which points touch the obstacles. It keeps, for every point and box, from which side of
/// each box axis the point came. Depth is measured to that side. A point pushed past the middle of
/// a thin box is therefore pushed out where it entered, and the potential kappa A d^2 / 2 stays
/// continuous. A point that crosses a box within one step is also pushed back.
class ContactFinder {
 public:
  /// `x`: the start positions of the nodes. Points and obstacles must outlive the finder.
  ContactFinder(const ContactPoints& points, const std::vector<Obstacle>& obstacles,
                const std::vector<Vec3>& x);
  /// Contacts for node positions x and velocities v (for contact damping), ordered by obstacle,
  /// then by point.
  /// `frames`: node positions that show how the surface is turned, which may be those at the start
  /// of a step.
  void find(const std::vector<Vec3>& x, const std::vector<Vec3>& v, const std::vector<Vec3>& frames,
            std::vector<Contact>& contacts);

  /// Penetration of one point at x into one obstacle; none outside.
  std::optional<Penetration> penetration(std::size_t obstacle, std::uint32_t point, const Vec3& x);
  /// Penetration at the end of a straight path, into the face that the point went through last; the
  /// same as penetration() if it was inside at the start.
  std::optional<Penetration> entry(std::size_t obstacle, std::uint32_t point, const StepPath& path);
  /// A contact of depth 0 and without force between a point and a face of an obstacle. `frame`: of
  /// the point.
  Contact contact(std::size_t obstacle, std::uint32_t point, const Vec3& normal,
                  const Mat3& frame) const;
  /// Updates the sides of a point that was not checked in the last steps and is at x, outside the
  /// obstacle.
  void take_sides(std::size_t obstacle, std::uint32_t point, const Vec3& x);

 private:
  using Sides = std::array<std::int8_t, 3>;  // -1 or 1 along each box axis

  const ContactPoints* points_;
  const std::vector<Obstacle>* obstacles_;
  std::vector<std::vector<Sides>> sides_;  // by obstacle; empty for planes
};

/// Points that touch the same obstacle as in the previous step keep the stretch of their stick
/// spring; for others it starts at zero. Both lists have the order of ContactFinder.
void keep_stick_springs(const std::vector<Contact>& before, std::vector<Contact>& now);

/// Friction of a contact over a step on a point of effective mass m. Without a stick spring,
/// Coulomb friction limited so that no step reverses the slip (eq. 66 of docs/method.md). With one,
/// the spring is in series with a slider that slides at mu f_n; integrated implicitly, stable for
/// any stiffness (eq. 67; Cundall and Strack 1979, "A discrete numerical model for granular
/// assemblies").
class FrictionLaw {
 public:
  FrictionLaw() = default;
  /// The contact has the stretch of its stick spring at the start of the step.
  FrictionLaw(const Contact& contact, double mass, double step);
  /// Starts another step of the same length: the contact has another stretch.
  void start(const Contact& contact);
  /// Change of the velocity of a point that moves at v [m/s]; `most`: mu f_n dt [N s].
  Padded slip_change(const Padded& v, double most) const {
    const Padded change = gain_ * (start_ + late_ * along_face(v));
    const double square = dot(change, change);
    const double largest = most * inverse_mass_;
    if (square > largest * largest) return -largest / std::sqrt(square) * change;
    return -change;
  }
  /// Sets stretch and stick_gain from slip_change of the contact, at the end of the step.
  void finish(Contact& contact) const;

 private:
  Padded along_face(const Padded& u) const { return u - dot(normal_, u) * normal_; }

  Padded normal_ = Padded::UnitZ();
  double inverse_mass_ = 0;  // [1/kg]
  double gain_ = 1;          // change per stretch and late_ times slip [1/s]; 1 without spring [1]
  double late_ = 1;          // dt + damping time [s]; 1 without a stick spring [1]
  double stick_ = 0;         // stiffness of the stick spring [N/m]
  double damping_ = 0;       // its damping time [s]
  double inverse_late_ = 1;  // [1/s]
  double stretch_ = 0;       // stretch by a change of the velocity of 1 m/s [s]
  double held_ = 0;          // its energy at the start [J]
  Padded start_ = Padded::Zero();  // its stretch at the start, along the face [m]
};

inline void FrictionLaw::start(const Contact& contact) {
  if (stick_ == 0) return;
  start_ = along_face(padded(contact.stretch));
  held_ = contact.stick_energy();
}

inline void FrictionLaw::finish(Contact& contact) const {
  if (stick_ == 0) return;
  contact.stretch = inverse_late_ * (damping_ * start_.head<3>() - stretch_ * contact.slip_change);
  contact.stick_gain = contact.stick_energy() - held_;
}

/// Applies friction over a step to a point of velocity v and mass m: sets slip_change, stretch and
/// stick_gain.
void apply_friction(Contact& contact, double mass, double step, const Vec3& v);

/// Applies friction to all contacts in turn, as points may share nodes. `v`: velocities of the
/// nodes after all other forces of the step. Returns the removed kinetic energy [J], including the
/// energy stored in stick springs.
double apply_friction(const ContactPoints& points, double step, std::vector<Contact>& contacts,
                      std::vector<Vec3>& v);

/// Energy of the contacts: sum of k d^2 / 2 and of the stick springs [J].
double contact_energy(const std::vector<Contact>& contacts);

}  // namespace springlod::sim
