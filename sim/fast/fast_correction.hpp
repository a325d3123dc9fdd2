#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "sim/correction/corner_watch.hpp"
#include "sim/correction/inversion_log.hpp"
#include "sim/correction/step_correction.hpp"
#include "sim/fast/fast_paths.hpp"
#include "sim/fast/look/corner_look.hpp"
#include "sim/fast/near_points.hpp"

namespace springlod::sim {

/// Corrects the drifts of a fast body for contacts and corners. A contact point or a corner may
/// depend on nodes of several blocks, so one thread corrects the body while the others wait; only
/// the corners are looked at by all. Calls for each drift, when all blocks have moved:
///
///   one thread:  correct(step); bool look = corners_due(take_travel(step));
///   do {
///     if (look) for each block, by any thread: look_at_corners(block);
///     one thread:  look = solve_corners();
///   } while (look);
///   one thread:  finish(step);
class FastCorrection {
 public:
  /// Everything must outlive this.
  struct Shared {
    const MassSpringModel* model;
    NearPoints::Shared points;
    FastBody* body;
    StepCorrection::Holds holds;
    Vec3 gravity;      ///< [m/s2]
    bool with_ledger;  ///< record the losses
    bool volumes;      ///< whether corners resist
  };
  explicit FastCorrection(const Shared& shared);

  /// Sets the contacts at the start.
  void start(std::vector<Contact> contacts) { solver_.set(std::move(contacts)); }
  /// Whether there is anything to correct at all, in any step.
  bool needed() const { return needed_; }

  /// Corrects for contacts, and for the corners that resisted in the last step.
  void correct(const FastStep& step);
  /// How far a node moved at most in the drift and by that correction together, relative to a rigid
  /// motion [m]. Call it once.
  double take_travel(const FastStep& step);
  /// `travel`: that.
  bool corners_due(double travel);
  void look_at_corners(std::uint32_t block);
  /// Returns whether to look again: the corners may have pressed others.
  bool solve_corners();
  /// Ends the correction.
  void finish(const FastStep& step);
  /// Books the part of the losses that depends on the forces at the end of the last step. Call it
  /// when the body has collected them.
  void book_end();

  const std::vector<Contact>& contacts() const { return solver_.now(); }
  /// How the last correction changed the nodes.
  const std::vector<NodeChange>& changes() const { return solver_.changes(); }
  /// Whose nodes have these changes, in the same order.
  const StepNodes& nodes() const { return solver_.nodes(); }
  /// Forces without damping on these nodes at the start of the drift, with a ledger [N].
  const std::vector<Vec3>& forces() const { return forces_; }
  /// The springs of anchors in the last step.
  const StepSprings& springs() const { return solver_.springs(); }
  /// Losses so far.
  const StepCorrection::Losses& losses() const { return losses_; }
  /// Number of the first step with a contact.
  const std::optional<std::uint64_t>& first_step() const { return first_step_; }
  /// The first point that tunnelled through a wall.
  const std::optional<Passage>& passage() const { return near_.passage(); }
  /// How far the corners and contacts of the last step moved a node at most after take_travel()
  /// [m].
  double shift() const { return shift_; }
  /// Largest StepCorners::largest_change() of a step since the last call [1].
  double largest_corner_change() const { return largest_corner_change_; }
  double take_largest_corner_change() { return std::exchange(largest_corner_change_, 0); }

  /// The inversions so far.
  const InversionLog& inversions() const { return inversions_; }

 private:
  void show_nodes();
  void finish_look();
  /// Adds to shift() what was solved since the last call, and returns it [m].
  double shifted();
  void apply(const FastStep& step);
  void note_inversions(const FastStep& step);
  /// Half the work of the elastic forces and of gravity on the displacements by the last
  /// correction, of a step of length `step` [s].
  StepCorrection::Losses half_work(double step);

  Shared shared_;
  bool needed_;
  FastPaths paths_;
  NearPoints near_;
  CornerWatch watch_;
  bool looking_ = false;
  // What the body has of the correction so far, by slot, and what it gets next.
  std::vector<Vec3> shown_;  // [m]
  std::vector<NodeChange> unseen_;
  std::vector<std::uint32_t> pressed_;  // nodes that were corrected in the last step
  CornerLook look_;
  std::vector<std::vector<std::uint32_t>> found_;  // by block: corners without a margin
  std::vector<double> dues_;                       // by block: travel at which corners are due [m]
  StepCorrection solver_;
  double booked_step_ = 0;  // length of the step whose end is not booked yet; 0: none [s]
  StepCorrection::Losses losses_;
  std::vector<Vec3> forces_;          // scratch of half_work() [N]
  double shift_ = 0;                  // [m]
  double largest_corner_change_ = 0;  // [1]
  InversionLog inversions_;
  std::optional<std::uint64_t> first_step_;
};

}  // namespace springlod::sim
