#pragma once

#include <cstdint>
#include <vector>

#include "sim/correction/plain_correction.hpp"
#include "sim/integrators/implicit_anchors.hpp"
#include "sim/integrators/implicit_springs.hpp"
#include "sim/integrators/stepper.hpp"

namespace springlod::sim {

/// Schemes with positions and velocities at the same instants. solve() implements the scheme. The
/// implicit schemes solve the normal forces of contacts too; friction is applied after it, limits
/// the slip, and corrects the positions by the slip that it removed. The steps of explicit ones are
/// corrected after it: see StepCorrection.
///
/// Its ledger holds the true energies of (x_n, v_n) and the work of each dissipative force in the
/// discrete scheme. The numerical gain or loss of an explicit scheme is lost_scheme, that of an
/// implicit one appears as the drift of the total.
class WholeStep : public StepByStep {
 public:
  void prepare() final;

  std::uint64_t spring_updates() const final { return spring_updates_; }
  /// Interpolates linearly between x_n and x_{n+1}.
  std::vector<Vec3> positions_at(double time) const final;
  State state() const final { return {x_, v_, time()}; }
  LedgerEntry ledger_entry() const final;

 protected:
  WholeStep(const MassSpringModel& model, const Scenario& scenario, const State& start, double step,
            const StepperOptions& options);

  /// Computes x_next_ and v_next_ from x_ and v_, without friction. Adds to spring_updates_ and,
  /// with a ledger, to lost_damping_.
  virtual void solve() = 0;
  /// Every implicit scheme calls this at the end of solve(). It sets v_next_ to the mean velocity
  /// over the step and records the damping losses.
  void finish_implicit(const ImplicitSprings& springs);
  /// Moves what anchors hold to the end of the step, in x_next_ too.
  void hold_nodes();

  bool with_ledger_;
  std::vector<Vec3> v_;                // at x_
  std::vector<Vec3> x_next_, v_next_;  // of the step that prepare() computed
  std::uint64_t spring_updates_ = 0;
  double lost_damping_ = 0;  // [J]
  /// What the anchors do in the step to x_{n+1}, by held node.
  struct AnchorStep {
    Vec3 impulse = Vec3::Zero();  // [N s]
    double work = 0;              // [J]
  };
  std::vector<AnchorStep> anchor_steps_;
  ImplicitAnchors implicit_anchors_;  // of an implicit scheme

 private:
  void commit() final;
  const std::vector<Vec3>& step_velocities() const final { return v_next_; }
  /// Energy of the body at x_n less that at the end of the step [J], without contacts and corners.
  double lost_energy() const;
  void correct();
  /// Books what the correction of a step adds to the energy of the body beyond its work. `free_x`,
  /// `free_v`: at its end, without it.
  void book_gains(const std::vector<Vec3>& free_x, const std::vector<Vec3>& free_v);
  /// Parts of a correction beside the contacts.
  struct Parts {
    bool corners = false;
    bool springs = false;
  };
  /// What the contacts and these parts add [J].
  double gain_by_shift(const std::vector<Vec3>& free_x, const std::vector<Vec3>& free_v,
                       const Parts& parts) const;
  void find_contacts();
  void add_friction();

  bool implicit_;
  bool volumes_;
  /// Finds what the anchors do in a step of an implicit scheme.
  void find_anchor_forces(const ImplicitSprings& springs);
  /// The impulses of contacts on held nodes, which their anchors take up.
  void absorb_contacts();
  /// Books what the springs of anchors did in the step.
  void book_springs();

  PlainCorrection correction_;  // of an explicit scheme
  std::vector<Contact> next_contacts_;
  // Energy at x_n of the corners that resist, as far as the losses contain it; the next step books
  // that of corners which others have pressed since they were checked [J].
  double booked_corners_;
  double anchor_energy_ = 0;  // of the springs of anchors at x_n [J]
  // Losses of the step to x_{n+1}, added to the ledger when the step is taken.
  LedgerEntry losses_, next_losses_;
};

}  // namespace springlod::sim
