#pragma once

#include <cstdint>
#include <optional>
#include <span>
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
  void set(std::vector<Contact> contacts);
  /// The contacts at the end of the last step, in the order of its checks; depth > 0.
  const std::vector<Contact>& now() const { return contacts_; }

  /// Begins a step with the nodes of the contacts.
  void begin(double step, const StepPaths& paths, StepNodes& nodes);
  /// The next of the contacts at the start of the step, or null.
  const Contact* next() const {
    return checked_ < contacts_.size() ? &contacts_[checked_] : nullptr;
  }
  /// Continues it, or ends it if its point has slid off an edge of the obstacle.
  void continue_next(StepNodes& nodes);
  /// Adds the contact of a point with an obstacle that it did not touch at the start of the step,
  /// if it does at the end; before next(). `path`: of the point in the free step.
  void check(std::uint32_t obstacle, std::uint32_t point, const StepPath& path, StepNodes& nodes);

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
  /// What the sweeps use of a contact, together in memory. The laws change when the contact turns
  /// or the step does.
  struct Touch {
    double normal_force = 0;              // so far [N]
    Padded slip_change = Padded::Zero();  // so far [m/s]
    Padded normal = Padded::Zero();       // of the contact
    NormalLaw law;
    FrictionLaw slider;
    double friction = 0;               // mu
    double mass = 0;                   // effective mass of the point [kg]
    PaddedPath path;                   // of the point
    double before = 0;                 // depth at the start of the step, along the normal [m]
    double level = 0;                  // depth = level - normal . x [m]
    std::uint32_t first = 0, end = 0;  // shares
  };
  struct Share {
    std::uint32_t slot = 0;  // in StepNodes
    double weight = 0;       // [1]
    double kick = 0;         // see ContactPoints::Share [1]
  };

  /// Gives a touch the shares of its point, and adds their nodes to those of the step.
  void gather_shares(std::uint32_t point, Touch& touch, StepNodes& nodes);
  void set_laws(const Contact& contact, Touch& touch) const;
  /// Ends next(); its energy is lost.
  void end_next();
  /// The contact of `before` under a face with that normal, whose surface has turned.
  Contact turned(const Contact& before, const Vec3& normal, const Touch& touch,
                 const StepNodes& nodes) const;
  /// See ContactPoints::frame; at the start of the step.
  Mat3 frame(std::uint32_t point, const Touch& touch, const StepNodes& nodes) const;
  std::span<const Share> shares(const Touch& touch) const {
    return {shares_.data() + touch.first, touch.end - touch.first};
  }
  /// Path of the point.
  PaddedPath path(const Touch& touch, const StepNodes& nodes) const;
  /// Moves the nodes of a point so that it moves by `change` [m].
  void push(const Touch& touch, const Padded& change, StepNodes& nodes) const;
  /// Updates the forces of a contact and the nodes of its point; returns the point's change [m].
  double update(Touch& touch, StepNodes& nodes) const;
  /// `at`: position of the point. Returns its change [m].
  Padded update_friction(Touch& touch, const Padded& at) const;
  Padded position(const Touch& touch, const StepNodes& nodes) const;
  /// Counts what the held nodes of a point take up of its impulse.
  void absorb(const Touch& touch, StepNodes& nodes) const;
  void book(const Touch& touch, const Contact& contact);
  /// Books the work of friction on what it moved the nodes itself.
  void book_slides(const StepNodes& nodes);

  const ContactPoints* points_;
  ContactFinder* finder_;
  std::uint64_t number_ = 0;            // of the step, counted from 1
  double step_ = 0, inverse_step_ = 0;  // [s], [1/s]
  bool new_shares_ = false;             // whether the next step begins without nodes and shares
  std::size_t checked_ = 0;             // contacts that this step has continued or added
  std::vector<Contact> contacts_;
  std::vector<Touch> touches_;  // by contact
  std::vector<Share> shares_;
  Losses losses_;
};

}  // namespace springlod::sim
