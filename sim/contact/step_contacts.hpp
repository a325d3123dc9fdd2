#pragma once

#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "sim/contact/contact.hpp"
#include "sim/contact/contact_points.hpp"
#include "sim/contact/normal_law.hpp"
#include "sim/correction/step_nodes.hpp"

namespace springlod::sim {

/// The contacts of a body in each step of an explicit scheme: section 9 of docs/method.md. Each
/// contact gets one force for the whole step, from the depths of its point at both ends
/// (NormalLaw), and friction. See StepCorrection.
class StepContacts {
 public:
  struct Losses {
    double contact = 0;   ///< [J]
    double friction = 0;  ///< [J]
  };

  /// Points and finder must outlive this.
  StepContacts(const ContactPoints& points, ContactFinder& finder)
      : points_(&points), finder_(&finder) {}

  /// The contacts at the start of a run.
  void set(std::vector<Contact> contacts) { contacts_ = std::move(contacts); }
  /// The contacts at the end of the last step; depth > 0.
  const std::vector<Contact>& now() const { return contacts_; }

  void begin(double step);
  /// The contacts at the start of the step. All of them must be checked.
  const std::vector<Contact>& before() const { return before_; }
  /// Continues one of them.
  void check(const Contact& before, StepNodes& nodes);
  /// Adds the contact of a point with an obstacle that it did not touch at the start of the step,
  /// if it does at the end. `path`: of the point in the free step.
  void check(std::uint32_t obstacle, std::uint32_t point, const StepPath& path, StepNodes& nodes);

  bool empty() const { return touches_.empty(); }
  /// Updates all contacts once. Returns the largest change of a point's position over the largest
  /// displacement of a point by its contact [1].
  double sweep(StepNodes& nodes);
  /// Updates until the contacts have converged.
  void solve(StepNodes& nodes);
  /// Ends the step: the nodes are at their final positions.
  void finish(StepNodes& nodes);
  /// Energy lost to the contacts of the step, without the part that the forces of the scheme take:
  /// see LedgerEntry.
  const Losses& losses() const { return losses_; }

 private:
  /// What a contact has only during a step.
  struct Touch {
    explicit Touch(std::uint32_t first_share) : first(first_share) {}

    NormalLaw law;
    FrictionLaw friction;
    double mass = 0;               // effective mass of the point [kg]
    StepPath path;                 // of the point
    double before = 0;             // depth at the start of the step, along the normal [m]
    double level = 0;              // depth = level - normal . x [m]
    std::uint32_t first, end = 0;  // shares
  };
  struct Share {
    std::uint32_t slot = 0;  // in StepNodes
    double weight = 0;       // [1]
    double kick = 0;         // see ContactPoints::Share [1]
  };

  /// Adds a touch of a point that has its shares, and their nodes to those of the step.
  Touch& add_touch(std::uint32_t point, StepNodes& nodes);
  /// See ContactPoints::frame; at the start of the step.
  Mat3 frame(std::uint32_t point, const Touch& touch, const StepNodes& nodes) const;
  /// Path of the point.
  StepPath path(const Touch& touch, const StepNodes& nodes) const;
  /// Completes a touch that has its path. `was`: see before(), or null. `end`: at the
  /// end of the path, if there is any.
  void set_up(const Contact& contact, const Contact* was, const std::optional<Penetration>& end,
              Touch& touch);
  /// Moves the nodes of a point so that it moves by `change` [m].
  void push(const Touch& touch, const Vec3& change, StepNodes& nodes) const;
  /// Updates the forces of a contact and the nodes of its point; returns the point's change [m].
  double update(const Touch& touch, Contact& contact, StepNodes& nodes) const;
  /// `at`: position of the point. Returns its change [m].
  Vec3 update_friction(const Touch& touch, const Vec3& at, Contact& contact) const;
  Vec3 position(const Touch& touch, const StepNodes& nodes) const;
  void book(const Touch& touch, const Contact& contact);
  /// Books the work of friction on what it moved the nodes itself.
  void book_slides(const StepNodes& nodes);

  const ContactPoints* points_;
  ContactFinder* finder_;
  std::uint64_t number_ = 0;            // of the step, counted from 1
  double step_ = 0, inverse_step_ = 0;  // [s], [1/s]
  // During a step, contacts_ has those of touches_, in which normal_force and slip_change are those
  // so far.
  std::vector<Contact> contacts_, before_;
  std::vector<Touch> touches_;
  std::vector<Share> shares_;
  Losses losses_;
};

}  // namespace springlod::sim
