#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "sim/contact/contact.hpp"
#include "sim/contact/contact_points.hpp"
#include "sim/contact/tunnel_watch.hpp"
#include "sim/fast/fast_body.hpp"
#include "sim/fast/passage.hpp"
#include "sim/fast/regions.hpp"
#include "sim/integrators/ledger.hpp"

namespace springlod::sim {

/// The contacts of a set of points of a fast body: the nodes of one block, or a whole skin. Stepper
/// works on vectors of all nodes; this class works on the points near an obstacle and on the forces
/// of the body. The derived classes decide which points are checked, and when.
class FastContacts {
 public:
  /// One step of the body.
  struct Step {
    std::uint64_t number = 0;
    MovingFrame frame;   ///< at the positions of this step
    MovingFrame kicked;  ///< after the kick
    double kick = 0;     ///< [s] > 0
    double length = 0;   ///< dt [s]
  };

  /// Data shared by all sets of one body; must outlive them.
  struct Shared {
    const ContactPoints* points;
    const std::vector<Obstacle>* obstacles;
    FastBody* body;
    ContactFinder* finder;
    TunnelCheck* walls;
  };

  virtual ~FastContacts() = default;

  /// Finds the contacts at the positions of the step. Adds their normal and friction forces to the
  /// forces that the body has collected.
  virtual void apply(const Step& step) = 0;

  /// Contacts of the last apply().
  const std::vector<Contact>& now() const { return contacts_; }
  /// Number of the first step with a contact.
  const std::optional<std::uint64_t>& first_step() const { return first_step_; }
  /// The first point that tunnelled through a wall.
  const std::optional<Passage>& passage() const { return passage_; }

  /// Adds the half of the losses of now() that is computed with the velocities before the kick, in
  /// a step of `length` [s]. Call it between apply() and the kick.
  void book_before_kick(double length, LedgerEntry& losses) const;
  /// Adds the half that is computed with the velocities after the kick. Call it between kick and
  /// drift.
  void book_after_kick(double length, LedgerEntry& losses) const;

 protected:
  struct Motion {
    Vec3 x;  ///< [m]
    Vec3 v;  ///< [m/s]
  };

  explicit FastContacts(const Shared& shared) : shared_(shared) {}
  FastContacts(const FastContacts&) = default;
  FastContacts(FastContacts&&) = default;

  const ContactPoints& points() const { return *shared_.points; }
  const std::vector<Obstacle>& obstacles() const { return *shared_.obstacles; }
  FastBody& body() const { return *shared_.body; }
  ContactFinder& finder() const { return *shared_.finder; }
  TunnelCheck& walls() const { return *shared_.walls; }

  /// Adds the contact of a point with an obstacle to now(), if there is one, and returns it.
  const Contact* add_contact(std::size_t obstacle, std::uint32_t point, const Motion& motion) {
    const std::optional<Contact> contact = finder().find_one(obstacle, point, motion.x, motion.v);
    if (!contact) return nullptr;
    contacts_.push_back(*contact);
    return &contacts_.back();
  }
  /// Notes the first step with a contact.
  void note_first(const Step& step) {
    if (!first_step_ && !contacts_.empty()) first_step_ = step.number;
  }
  /// Checks whether one of `points` tunnelled through a wall in the drift to step `number`, in a
  /// step of `length` [s]. `swept`: bounds of their paths in world axes [m]. `motion_of(point)`:
  /// position at the end, velocity of the drift.
  template <class MotionOf>
  void check_walls(std::uint64_t number, double length, const Box3& swept,
                   const std::vector<std::uint32_t>& points, const MotionOf& motion_of) {
    for (std::size_t w = 0; w < walls().wall_count(); ++w) {
      if (!bounds_of(walls().wall(w)).intersects(swept)) continue;
      for (const std::uint32_t point : points) {
        const Motion motion = motion_of(point);
        check_wall({number, w, point, motion.x - length * motion.v, motion.x});
      }
    }
  }

  std::vector<Contact> contacts_;

 private:
  /// Velocity of the point of contact number `contact` now [m/s].
  virtual Vec3 velocity_before_kick(std::size_t contact) const = 0;
  virtual Vec3 velocity_after_kick(std::size_t contact) const = 0;

  /// Stores the first passage through a wall.
  void check_wall(const Passage& passage);

  Shared shared_;
  std::optional<std::uint64_t> first_step_;
  std::optional<Passage> passage_;
};

}  // namespace springlod::sim
