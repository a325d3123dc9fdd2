#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "sim/contact/contact.hpp"
#include "sim/contact/contact_points.hpp"
#include "sim/contact/node_change.hpp"
#include "sim/contact/normal_law.hpp"

namespace springlod::sim {

/// Solves the contacts of a body after each step of an explicit scheme: section 9 of
/// docs/method.md. The scheme first takes the step without contact. Then each contact gets one
/// force for the whole step, from the depths of its point at both ends (NormalLaw), and friction.
/// The contacts that share nodes are solved together by Gauss-Seidel sweeps. The contacts therefore
/// do not bound the time step. Calls for each step, in this order:
///
///   begin(step);
///   for each obstacle, for each point that may touch it: check(...);
///   solve(path_of, number_of);
///
/// Every contact in before() must be checked.
class StepContacts {
 public:
  /// Path of a point or a node in the step without contact [m].
  struct Path {
    Vec3 from = Vec3::Zero();
    Vec3 to = Vec3::Zero();
  };
  struct Losses {
    double contact = 0;   ///< [J]
    double friction = 0;  ///< [J]
  };

  /// Points and finder must outlive this. `number_count`: see solve().
  StepContacts(const ContactPoints& points, ContactFinder& finder, std::uint32_t number_count);

  /// The contacts at the start of a run.
  void set(std::vector<Contact> contacts) { contacts_ = std::move(contacts); }
  /// The contacts at the end of the last step; depth > 0.
  const std::vector<Contact>& now() const { return contacts_; }

  void begin(double step);
  /// The contacts at the start of the step.
  const std::vector<Contact>& before() const { return before_; }
  /// Adds the contact of a point with an obstacle, if they touch during the step. `was`: their
  /// contact in before(), or null.
  void check(std::uint32_t obstacle, std::uint32_t point, const Contact* was, const Path& path);
  /// Solves the contacts found by check(). path_of(node): path of a node in the free step;
  /// number_of(node): its number below number_count, unique among the nodes of the points.
  template <class PathOf, class NumberOf>
  void solve(const PathOf& path_of, const NumberOf& number_of) {
    gather(number_of);
    for (Node& node : nodes_) node.path = path_of(node.node);
    solve_gathered();
  }
  /// How the contacts change the nodes at the end of the step.
  const std::vector<NodeChange>& changes() const { return changes_; }
  /// Energy lost to the contacts of the step, without the part that the forces of the scheme take:
  /// see NodeChange.
  const Losses& losses() const { return losses_; }

 private:
  static constexpr std::uint32_t kNone = static_cast<std::uint32_t>(-1);

  /// A node of at least one touch.
  struct Node {
    std::uint32_t node = 0;
    Path path;
    Vec3 slide = Vec3::Zero();  // displacement by friction [m]
  };
  /// A contact during the step.
  struct Touch {
    Contact contact;  // normal_force and slip_change: so far
    NormalLaw law;
    FrictionLaw friction;
    double mass = 0;                   // effective mass of the point [kg]
    Path path;                         // of the point
    double before = 0;                 // depth at the start of the step, along the normal [m]
    double level = 0;                  // depth = level - normal . x [m]
    std::uint32_t first = 0, end = 0;  // shares
  };
  struct Share {
    std::uint32_t node = 0;  // number in nodes_
    double weight = 0;       // [1]
    double kick = 0;         // see ContactPoints::Share [1]
  };

  template <class NumberOf>
  void gather(const NumberOf& number_of) {
    for (Touch& touch : touches_) {
      touch.first = static_cast<std::uint32_t>(shares_.size());
      for (const ContactPoints::Share& share : points_->shares(touch.contact.point))
        shares_.push_back({gathered(share.node, number_of(share.node)), share.weight, share.kick});
      touch.end = static_cast<std::uint32_t>(shares_.size());
    }
    for (const std::uint32_t number : used_) slot_[number] = kNone;
    used_.clear();
  }
  std::uint32_t gathered(std::uint32_t node, std::uint32_t number);
  void solve_gathered();
  /// Updates all contacts once. Returns the largest change of a point's position over the largest
  /// displacement of a point by its contact [1].
  double sweep();
  /// Updates the forces of a contact and the nodes of its point; returns the point's change [m].
  double update(Touch& touch);
  /// `at`: position of the point. Returns its change [m].
  Vec3 update_friction(Touch& touch, const Vec3& at);
  Vec3 position(const Touch& touch) const;
  void finish();
  void book(const Touch& touch);

  const ContactPoints* points_;
  ContactFinder* finder_;
  double step_ = 0;       // [s]
  bool coupled_ = false;  // some node belongs to several touches
  std::vector<Contact> contacts_, before_;
  std::vector<Touch> touches_;
  std::vector<Share> shares_;
  std::vector<Node> nodes_;
  std::vector<Vec3> at_;             // positions of the nodes at the end of the step, so far [m]
  std::vector<std::uint32_t> slot_;  // number of a node -> place in nodes_, or kNone
  std::vector<std::uint32_t> used_;  // slots in use
  std::vector<NodeChange> changes_;
  Losses losses_;
};

}  // namespace springlod::sim
