#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "model/mass_spring.hpp"
#include "sim/contact/contact_skin.hpp"
#include "sim/held/held_nodes.hpp"
#include "sim/scenario.hpp"

namespace springlod::sim {

/// The contact points of a body (BodySurface), or the points of a skin. A point p is at
/// sum w_i x_i. A force f at p acts as w_i f on the nodes. These forces do the same work and have
/// the same resultant force and torque as f, since the w_i add up to 1 and reproduce p.
class ContactPoints {
 public:
  struct Share {
    std::uint32_t node = 0;
    double weight = 0;  ///< w_i [1]
    double kick = 0;    ///< change of the node's velocity when an impulse changes the point's [1]
  };

  /// How the surface yields at a point, in world axes.
  struct Yielding {
    double normal = 0;             ///< along the normal by a unit normal force [m/N]
    double tangential = 0;         ///< along the face by a unit force along it, mean [m/N]
    Vec3 sideways = Vec3::Zero();  ///< along the face by a unit normal force [m/N]
  };

  // Contacts do not move the nodes of `held`; null: none. Points all of whose nodes are held are
  // left out: nothing that they touch would move the body.

  /// Those of body_surface, in its order.
  explicit ContactPoints(const MassSpringModel& model, const HeldNodes* held = nullptr);
  /// Throws InputError for a skin that does not fit the model.
  ContactPoints(const MassSpringModel& model, const ContactSkin& skin,
                const HeldNodes* held = nullptr);

  std::uint32_t count() const { return static_cast<std::uint32_t>(area_.size()); }
  std::uint32_t node_count() const { return static_cast<std::uint32_t>(node_mass_.size()); }
  double node_mass(std::uint32_t node) const { return node_mass_[node]; }  ///< [kg]
  double area(std::size_t point) const { return area_[point]; }            ///< [m2]
  /// Whether the surface yields at the point, beyond what the nodes do.
  bool yields(std::size_t point) const { return !compliance_[point].isZero(0); }
  /// Whether its compliance turns with the body.
  bool turns(std::size_t point) const { return turns_[point] != 0; }
  /// The deformation gradient at the point, the identity at rest; `position`: of each node. Of use
  /// only to yielding(): the identity for points that do not yield.
  template <class Position>
  Mat3 frame(std::size_t point, const Position& position) const {
    if (!turns(point)) return Mat3::Identity();
    Mat3 frame = Mat3::Zero();
    for (std::uint32_t e = start_[point]; e < start_[point + 1]; ++e) {
      const Vec3& x = position(shares_[e].node);
      for (int axis = 0; axis < 3; ++axis) frame.col(axis) += x * gradient_[e][axis];
    }
    return frame;
  }
  /// Its compliance under a face with the outward normal `normal`: eq. 65c of docs/method.md.
  Yielding yielding(std::size_t point, const Vec3& normal, const Mat3& frame) const;
  /// Damping time of the compliance: mean of the springs of the nodes of the point [s].
  double compliance_damping(std::size_t point) const { return compliance_damping_[point]; }
  /// Stiffness of its contact with an obstacle, in series with a compliance [m/N]: k_n in eq. 64 of
  /// docs/method.md [N/m]. If the obstacle has no stiffness, BodySurface::contact takes its place.
  double stiffness(std::size_t point, const Obstacle& obstacle, double compliance) const {
    const double bare =
        obstacle.stiffness ? *obstacle.stiffness * area_[point] : automatic_stiffness_[point];
    return bare / (1 + bare * compliance);
  }
  /// Damping time of that contact [s]: beta_n in eq. 64.
  double damping(std::size_t point, const Obstacle& obstacle, double compliance) const {
    const double given =
        stiffness(point, obstacle, compliance) * compliance;  // fraction of the depth [1]
    return (1 - given) * obstacle.damping + given * compliance_damping_[point];
  }
  /// Effective mass for an impulse at the point, 1 / sum (w_i^2 / m_i) over nodes that are not held
  /// [kg].
  double mass(std::size_t point) const { return mass_[point]; }
  /// sum |w_i| [1]: the displacement of the point / the largest displacement of its nodes is at
  /// most this.
  double reach(std::size_t point) const { return reach_[point]; }
  std::span<const Share> shares(std::size_t point) const {
    return {shares_.data() + start_[point], start_[point + 1] - start_[point]};
  }
  /// Number of the node that the point is, in the model or in the base; counted from 0.
  std::uint32_t number(std::size_t point) const { return number_[point]; }
  /// For messages, counted from 1: "node 7", "the surface at node 7", "the surface at node 7 of the
  /// base".
  std::string name(std::size_t point) const;

  /// Position or velocity of a point, from those of the nodes.
  Vec3 interpolate(std::size_t point, const std::vector<Vec3>& nodes) const {
    Vec3 sum = Vec3::Zero();
    for (const Share& share : shares(point)) sum += share.weight * nodes[share.node];
    return sum;
  }
  /// Adds a force at the point [N] to the forces on the nodes.
  void add_force(std::size_t point, const Vec3& force, std::vector<Vec3>& forces) const {
    for (const Share& share : shares(point)) forces[share.node] += share.weight * force;
  }
  /// Changes the point's velocity (or position) by `change`, as an impulse at the point would.
  void kick(std::size_t point, const Vec3& change, std::vector<Vec3>& nodes) const {
    for (const Share& share : shares(point)) nodes[share.node] += share.kick * change;
  }

 private:
  /// The properties of a point that is complete but for them.
  struct Surface {
    double area = 0;                 // [m2]
    double contact = 0;              // see BodySurface [N/m]
    Mat3 compliance = Mat3::Zero();  // at rest [m/N]
  };
  void set_gradients(const MassSpringModel& model, std::uint32_t point);
  void end_point(const MassSpringModel& model, std::uint32_t number, const Surface& surface,
                 const HeldNodes* held);

  /// Adds the shares of a point. Returns false, and adds none, if all its nodes are held.
  bool add_shares(const Binding& of_nodes, std::uint32_t point, const HeldNodes* held);

  std::vector<double> node_mass_;
  enum class Names { nodes, surface, skin } names_ = Names::nodes;  // what the points are called
  std::vector<std::uint32_t> start_{0};
  std::vector<Share> shares_;
  /// By share: the sum of x_i gradient_i^T is the deformation gradient at the point. Apart from the
  /// shares, because most steps do not use them. Zero for points of which turns() is false [1/m].
  std::vector<Vec3> gradient_;
  std::vector<double> area_, automatic_stiffness_;
  std::vector<Mat3> compliance_;  // at rest [m/N]
  std::vector<std::uint8_t> turns_;
  std::vector<double> compliance_damping_, mass_, reach_;
  std::vector<std::uint32_t> number_;
};

}  // namespace springlod::sim
