#pragma once

#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <vector>

#include "model/mass_spring.hpp"
#include "sim/contact/contact.hpp"
#include "sim/contact/contact_points.hpp"
#include "sim/contact/tunnel_watch.hpp"
#include "sim/correction/inversion.hpp"
#include "sim/correction/inversion_log.hpp"
#include "sim/held/anchor_forces.hpp"
#include "sim/held/anchor_springs.hpp"
#include "sim/integrators/integrator.hpp"
#include "sim/integrators/ledger.hpp"
#include "sim/scenario.hpp"

namespace springlod::sim {

/// One scheme that advances one body step by step. `run` calls it as follows:
///
///   prepare(); { read step n; advance(steps); } ...
///
/// prepare() computes the step to x_{n+1}. advance() takes it and computes the next, `steps` times.
/// Between these calls everything below is valid and refers to the time t_n = n dt. Model and
/// scenario must outlive the stepper.
class Stepper {
 public:
  virtual ~Stepper() = default;
  Stepper(const Stepper&) = delete;
  Stepper& operator=(const Stepper&) = delete;

  virtual void prepare() = 0;
  /// Takes at most that many steps. Returns early if the motion asks for a check of the body: see
  /// watch(). Throws TunnelError as soon as a node has gone through a box.
  virtual void advance(std::uint64_t steps) = 0;
  /// Continues from x_n with steps of another length [s]. Returns false if the scheme cannot.
  virtual bool change_step(double /*step*/) { return false; }

  /// What a scheme looks for in every step, if it can.
  struct Watch {
    double speed = std::numeric_limits<double>::infinity();   ///< of the fastest node [m/s]
    double strain = std::numeric_limits<double>::infinity();  ///< of the most strained spring [1]
    double corner_change =
        std::numeric_limits<double>::infinity();  ///< see StepCorners::largest_change [1]
  };
  /// From now on, advance() returns after a step in which one of these limits was exceeded.
  virtual void watch(const Watch& /*limits*/) {}
  /// Whether one of them was exceeded in the last step, even if advance() took all its steps.
  virtual bool stopped() const { return false; }
  /// The largest change in a step of the J of a corner near inversion, since the last call [1].
  virtual double take_corner_change() { return 0; }

  std::uint64_t step_number() const { return n_; }
  double time() const { return time_of(n_); }
  double step() const { return step_; }
  /// Spring evaluations so far, over all iterations: the deterministic cost.
  virtual std::uint64_t spring_updates() const = 0;
  /// Steps whose solver used all its iterations without reaching its tolerance. Always 0 for
  /// schemes with a fixed number of iterations, which have no tolerance.
  virtual std::uint64_t unconverged_steps() const { return 0; }

  const std::vector<Vec3>& positions() const { return x_; }
  const std::vector<Contact>& contacts() const { return contacts_; }
  /// The corners that were inside out at the end of a step, so far.
  const Inversions& inversions() const { return inversions_; }
  /// When nodes first touched an obstacle [s].
  std::optional<double> first_contact() const { return first_contact_; }
  /// Positions interpolated between x_n and x_{n+1} as the scheme defines (t_n <= time <= t_{n+1}).
  virtual std::vector<Vec3> positions_at(double time) const = 0;
  virtual State state() const = 0;
  Vec3 center_of_mass() const;
  Vec3 center_velocity() const;  ///< of the displacement of a step
  /// Work of the anchors on the body so far [J].
  virtual double anchor_work() const { return anchor_forces_.work(); }
  /// What each anchor has done until t_n.
  const std::vector<AnchorSum>& anchor_sums() const { return anchor_forces_.sums(); }
  /// Energies at t_n and losses so far; what is exact depends on the scheme.
  virtual LedgerEntry ledger_entry() const = 0;
  /// Sum of m v . v / 2 [J] for the displacement of a step, and the node with the largest term.
  double kinetic_of_step(std::uint32_t* fastest) const;

 protected:
  /// `skin`: where the body touches obstacles; null: at its nodes.
  Stepper(const MassSpringModel& model, const Scenario& scenario, const State& start, double step,
          const ContactSkin* skin, const std::vector<Anchor>& anchors);

  double time_of(std::uint64_t n) const {
    return start_time_ + static_cast<double>(n - start_n_) * step_;
  }
  /// Displacement of the step to or from x_n over its length, with that by contacts and corners.
  virtual const std::vector<Vec3>& step_velocities() const = 0;
  /// Gravitational potential energy relative to the start [J].
  double gravity_energy() const;

  const MassSpringModel* model_;
  Vec3 gravity_;
  double step_;
  std::uint64_t n_ = 0;
  // The time at which steps of this length began.
  std::uint64_t start_n_ = 0;
  double start_time_ = 0;  // [s]
  std::vector<Vec3> x_;
  std::size_t obstacle_count_;
  HeldNodes held_;
  AnchorSprings anchor_springs_;
  AnchorForces anchor_forces_;
  ContactPoints points_;
  ContactFinder finder_;
  std::vector<Contact> contacts_;
  TunnelCheck walls_;
  std::optional<double> first_contact_;  // [s]
  Inversions inversions_;

  /// Moves what the anchors hold to where it is at step n.
  void move_anchors(std::uint64_t n);
  /// Takes the inversions recorded by this scheme so far.
  void take(const InversionLog& log);

 private:
  double total_mass_ = 0;
  Vec3 first_center_;
};

/// A scheme that takes one step after the other.
class StepByStep : public Stepper {
 public:
  void advance(std::uint64_t steps) final;

 protected:
  using Stepper::Stepper;
  /// Takes the step to x_{n+1}.
  virtual void commit() = 0;
  /// Records the corners inside out at x_n, once it is committed. `late`: see InversionLog.
  void note_inversions(const std::vector<std::uint32_t>& now,
                       const std::vector<std::uint32_t>& late);

 private:
  InversionLog log_;
};

struct StepperOptions {
  Integrator integrator = Integrator::symplectic_euler;
  SolverOptions solver = {};
  bool ledger = true;   ///< record the losses
  bool volumes = true;  ///< whether corners resist inversion; only the explicit schemes have it
  /// Where the body touches obstacles; none: at its nodes.
  std::shared_ptr<const ContactSkin> skin = nullptr;
  std::vector<Anchor> anchors = {};
};

}  // namespace springlod::sim
