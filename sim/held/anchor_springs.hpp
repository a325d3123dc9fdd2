#pragma once

#include <cstdint>
#include <vector>

#include "model/mass_spring.hpp"
#include "sim/held/anchor_forces.hpp"
#include "sim/held/held_nodes.hpp"

namespace springlod::sim {

/// The nodes that anchors pull with springs (Anchor::spring). With e = x - p the distance from the
/// place p where the anchor would hold the node, the force on it is - k e - c de/dt. Each node is
/// named by its index among them.
class AnchorSprings {
 public:
  /// `start`: positions of all nodes at the start. Throws InputError: see validate.
  AnchorSprings(const MassSpringModel& model, const std::vector<Anchor>& anchors,
                const std::vector<Vec3>& start);

  bool empty() const { return places_.empty(); }
  std::uint32_t count() const { return places_.count(); }
  const std::vector<std::uint32_t>& nodes() const { return places_.nodes(); }
  std::uint32_t node(std::size_t spring) const { return places_.node(spring); }
  double stiffness(std::size_t spring) const { return stiffness_[spring]; }  ///< k [N/m]
  double damping(std::size_t spring) const { return damping_[spring]; }      ///< c [N s/m]
  double mass(std::size_t spring) const { return mass_[spring]; }            ///< of the node [kg]

  /// Moves the places to where they are at that time [s].
  void move_to(double time) { places_.move_to(time); }
  const Vec3& place(std::size_t spring) const { return places_.at()[spring]; }
  const std::vector<Vec3>& places() const { return places_.at(); }

  /// Adds what a spring does in a step, at the end of which the places are: the force [N] is
  /// constant over the step, and its work is done on the path of the place from `before` [m].
  void book(std::size_t spring, double step, const Vec3& force, const Vec3& before,
            AnchorForces& forces) const {
    forces.add(places_, spring, step * force, force.dot(place(spring) - before));
  }

 private:
  HeldNodes places_;
  std::vector<double> stiffness_, damping_, mass_;
};

}  // namespace springlod::sim
