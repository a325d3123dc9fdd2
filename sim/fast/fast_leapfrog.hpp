#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "sim/fast/fast_anchors.hpp"
#include "sim/fast/fast_correction.hpp"
#include "sim/fast/fast_model.hpp"
#include "sim/fast/fast_watch.hpp"
#include "sim/fast/step_team.hpp"
#include "sim/integrators/stepper.hpp"

namespace springlod::sim {

struct FastOptions {
  bool ledger = true;   ///< record the losses
  bool volumes = true;  ///< whether corners resist inversion
  Precision precision = Precision::double_precision;
  std::uint32_t threads = 1;  ///< at most; 0: chosen by body size. Does not change the result
  /// The model laid out for `precision`, shared by many runs; null: made for this run.
  std::shared_ptr<const FastModel> layout = nullptr;
  /// Contact skin; null: the nodes are the contact points.
  std::shared_ptr<const ContactSkin> skin = nullptr;
  std::vector<Anchor> anchors = {};
};

/// The scheme of Leapfrog with symplectic Euler's damping, on a body in a fast layout: the same
/// steps up to rounding, in single or double precision. The number of threads does not change the
/// result.
///
/// Positions and velocities are relative to a frame that follows the body in free fall, so the
/// numbers resolve only the motion of the nodes relative to each other. Each step is one pass
/// through memory: the forces, kick and drift of a block follow directly on one another.
class FastLeapfrog final : public Stepper {
 public:
  FastLeapfrog(const MassSpringModel& model, const Scenario& scenario, const State& start,
               double step, const FastOptions& options);

  void prepare() override;
  void advance(std::uint64_t steps) override;
  bool change_step(double step) override;
  void watch(const Watch& limits) override;
  bool stopped() const override { return watch_.stopped(); }
  double take_corner_change() override { return correction_.take_largest_corner_change(); }
  double anchor_work() const override { return anchor_forces_.work() + anchors_.half_work(); }

  std::uint64_t spring_updates() const override { return n_ * model_->spring_count(); }
  /// x_n + (t - t_n) v+
  std::vector<Vec3> positions_at(double time) const override;
  /// x_n and the mean of v- and v+.
  State state() const override;
  LedgerEntry ledger_entry() const override;

 private:
  /// One pass over all blocks, starting at step `number`.
  struct Pass {
    std::uint64_t number = 0;
    double kick = 0;   ///< [s]; 0: no forces are computed
    double drift = 0;  ///< [s]
  };
  /// Damping losses of a block [J], without the share of v+, which is added before the drift.
  struct Losses {
    double until_now = 0;
    double next = 0;
  };

  const std::vector<Vec3>& step_velocities() const override { return v_step_; }
  /// The work of one thread.
  struct Share {
    StepTeam::Member member;
    std::uint32_t first = 0, end = 0;  // blocks
    std::uint32_t kicks = 0;           // so far
  };

  /// Calls work(share, frame) on all threads with the current frame, which is then replaced by the
  /// returned one.
  void share_out(const std::function<MovingFrame(Share&, const MovingFrame&)>& work);

  // Called by these threads:

  /// `passes` from step n_ on, fewer if the watch stops them. Returns the frame at their end.
  MovingFrame go(std::uint64_t passes, Share& share, MovingFrame frame);
  MovingFrame pass(const Pass& pass, Share& share, const MovingFrame& frame);
  /// Reads the state at the current step, kicks the body and reads the velocities after the kick.
  /// Returns the frame after the kick.
  MovingFrame observe(Share& share, MovingFrame frame);
  MovingFrame take_new_frame(const Share& share);
  void find_and_move(const Pass& pass, Share& share);
  /// Corrects a drift for contacts and corners, when all blocks have moved.
  void correct(const FastStep& step, const Share& share);
  /// Uses what the looks of all threads have found; ends the correction if no other look follows.
  void end_look(const FastStep& step);
  /// Waits for the forces of the other blocks that this one needs.
  void wait_for_others(std::uint32_t block, const Share& share) const;

  void kick_and_drift(const Pass& pass, std::uint32_t block);
  void move_block(const Pass& pass, std::uint32_t block);
  void kick_and_book(const Pass& pass, std::uint32_t block);
  void drift_and_book(const Pass& pass, std::uint32_t block);
  MovingFrame after(const Pass& pass, const MovingFrame& frame) const;
  /// The drift of a pass that begins with `frame`.
  FastStep drift_step(const Pass& pass, const MovingFrame& frame) const;
  void finish_observation();
  /// Gives the held nodes the velocities of their anchors before and after the kick at step n_.
  void observe_held();
  double kinetic() const;
  void gather_corrections();
  void throw_if_tunnelled() const;

  std::shared_ptr<const FastModel> layout_;
  std::unique_ptr<FastBody> body_;
  StepTeam team_;
  Milestones found_;  // number of kicks for which each block has computed its forces
  bool with_ledger_;
  MovingFrame frame_;
  std::uint64_t reached_ = 0;  // step at the end of the last drift
  bool volumes_;
  FastCorrection correction_;
  FastAnchors anchors_;
  FastWatch watch_;
  std::vector<Losses> losses_;     // by block
  std::vector<MovingFrame> sums_;  // over the nodes of each block
  double lost_to_new_steps_ = 0;   // [J]
  std::vector<Vec3> v_minus_, v_plus_;
  std::vector<Vec3> v_step_;  // displacement of the last step over its length [m/s]
};

}  // namespace springlod::sim
