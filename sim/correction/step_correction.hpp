#pragma once

#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "sim/contact/step_contacts.hpp"
#include "sim/correction/corner_watch.hpp"
#include "sim/correction/step_corners.hpp"
#include "sim/correction/step_nodes.hpp"
#include "sim/held/step_springs.hpp"

namespace springlod::sim {

/// Corrects each step of an explicit scheme for contacts, corners and springs of anchors, so that
/// they do not bound it: section 9 of docs/method.md. The scheme takes the step without them. Then
/// the contacts and the springs get their forces by Gauss-Seidel sweeps, and corners that are near
/// inversion as the contacts have left them are solved together with the contacts. Calls for each
/// step, in this order:
///
///   begin(step, paths);
///   for each obstacle:
///     for each of its contacts in the last step, or point that may touch it: continue_contact();
///                                                                    or check_contact(...);
///   solve_contacts();
///   solve_resisting(watch);
///   for each corner that is near inversion: check_corner(...);
///   while (solve_corners()) for each corner that is near inversion now: check_corner(...);
///   finish();
class StepCorrection {
 public:
  struct Losses {
    double contact = 0;   ///< [J]
    double friction = 0;  ///< [J]
    double corners = 0;   ///< [J]
    double anchors = 0;   ///< to their springs [J]
  };

  /// What holds a body.
  struct Holds {
    const HeldNodes* held = nullptr;         ///< null: none
    const AnchorSprings* springs = nullptr;  ///< null: none
  };

  /// Model, points, finder and what holds the body must outlive this. `volumes`: whether corners
  /// resist.
  StepCorrection(const MassSpringModel& model, const ContactPoints& points, ContactFinder& finder,
                 bool volumes, const Holds& holds)
      : nodes_(model.node_count(), holds.held,
               holds.springs != nullptr ? holds.springs->nodes() : std::vector<std::uint32_t>()),
        contacts_(points, finder),
        corners_(model, volumes, holds.held),
        springs_(holds.springs) {}

  /// The contacts at the start of a run.
  void set(std::vector<Contact> contacts) { contacts_.set(std::move(contacts)); }
  /// The contacts at the end of the last step.
  const std::vector<Contact>& now() const { return contacts_.now(); }

  /// The paths must outlive the step. The held nodes and the places of the springs are where they
  /// are at its end. `step` [s].
  void begin(double step, const StepPaths& paths);
  // See StepContacts.
  const Contact* next_contact() const { return contacts_.next(); }
  void continue_contact() { contacts_.continue_next(nodes_); }
  void check_contact(std::uint32_t obstacle, std::uint32_t point, const StepPath& path) {
    contacts_.check(obstacle, point, path, nodes_);
  }
  /// Solves the contacts and the springs of anchors.
  void solve_contacts();
  /// Solves the corners that resisted at the end of the last step together with the contacts, if
  /// corners resist at all.
  void solve_resisting(const CornerWatch& watch);
  /// The nodes, as the contacts and corners so far have moved them.
  const StepNodes& nodes() const { return nodes_; }
  /// See StepNodes.
  double take_travel() { return nodes_.take_travel(); }
  /// See StepCorners::check.
  void check_corner(std::uint32_t corner, bool resisted) {
    corners_.check(corner, resisted, nodes_);
  }
  /// Solves the corners, the springs and the contacts together. Returns whether to look for further
  /// corners, which the new ones may have pressed.
  bool solve_corners();
  void finish();

  /// How the nodes change at the end of the step.
  const std::vector<NodeChange>& changes() const { return changes_; }
  /// The same of the nodes that are not held.
  std::span<const NodeChange> free_changes() const {
    return std::span(changes_).subspan(nodes_.held_count());
  }
  const StepSprings& springs() const { return springs_; }
  /// Energy lost in the step, without the part that the forces of the scheme take.
  const Losses& losses() const { return losses_; }
  /// See StepCorners.
  const std::vector<std::uint32_t>& resisting() const { return corners_.resisting(); }
  const std::vector<std::uint32_t>& inverted() const { return corners_.inverted(); }
  const std::vector<std::uint32_t>& late_inverted() const { return corners_.late_inverted(); }
  double largest_corner_change() const { return corners_.largest_change(); }

 private:
  /// Solves the corners that were checked, the springs and the contacts together. Returns whether
  /// any corner is new since the last call.
  bool solve_together();

  double step_ = 0;  // [s]
  int rounds_ = 0;   // of solve_corners() with new corners
  StepNodes nodes_;
  StepContacts contacts_;
  StepCorners corners_;
  StepSprings springs_;
  std::vector<NodeChange> changes_;
  Losses losses_;
};

}  // namespace springlod::sim
