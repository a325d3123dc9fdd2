#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "model/mass_spring.hpp"
#include "sim/contact/contact.hpp"
#include "sim/contact/contact_points.hpp"
#include "sim/contact/tunnel_watch.hpp"
#include "sim/integrators/integrator.hpp"
#include "sim/integrators/ledger.hpp"
#include "sim/scenario.hpp"

namespace springlod::sim {

/// One scheme at work on one body, step by step, as `run` drives it:
///
///   prepare(); { look at step n; advance(steps); } ...
///
/// prepare() works out the way to x_{n+1}; advance() goes it and works out the next, as often as it
/// is told. In between everything below is valid and speaks of the time t_n = n dt. Model and
/// scenario must outlive the stepper.
class Stepper {
 public:
  virtual ~Stepper() = default;
  Stepper(const Stepper&) = delete;
  Stepper& operator=(const Stepper&) = delete;

  virtual void prepare() = 0;
  /// Throws TunnelError as soon as a node has gone through a box.
  virtual void advance(std::uint64_t steps) = 0;
  /// Goes on from x_n with steps of another length [s]. Returns whether the scheme can.
  virtual bool change_step(double /*step*/) { return false; }

  std::uint64_t step_number() const { return n_; }
  double time() const { return time_of(n_); }
  double step() const { return step_; }
  /// Springs evaluated so far, every one of every iteration counted: the deterministic cost.
  virtual std::uint64_t spring_updates() const = 0;
  /// Steps whose solver used up its iterations short of its tolerance. Schemes that take a fixed
  /// number of iterations promise no tolerance and have none.
  virtual std::uint64_t unconverged_steps() const { return 0; }

  const std::vector<Vec3>& positions() const { return x_; }
  const std::vector<Contact>& contacts() const { return contacts_; }
  /// When nodes first touched an obstacle [s].
  std::optional<double> first_contact() const { return first_contact_; }
  /// Positions on the way that the scheme draws from x_n to x_{n+1} (t_n <= time <= t_{n+1}).
  virtual std::vector<Vec3> positions_at(double time) const = 0;
  virtual State state() const = 0;
  Vec3 center_of_mass() const;
  Vec3 center_velocity() const;  ///< from the velocities with which the body goes on
  /// Energies at t_n and losses so far; what is exact depends on the scheme.
  virtual LedgerEntry ledger_entry() const = 0;
  /// Sum of m v . v / 2 [J] of the velocities with which the body goes on, and the node that has
  /// most of it.
  double kinetic_after(std::uint32_t* fastest) const;

 protected:
  /// `skin`: where the body touches obstacles; null: at its nodes.
  Stepper(const MassSpringModel& model, const Scenario& scenario, const State& start, double step,
          const ContactSkin* skin);

  double time_of(std::uint64_t n) const {
    return start_time_ + static_cast<double>(n - start_n_) * step_;
  }
  /// The velocities with which the body goes on from x_n.
  virtual const std::vector<Vec3>& velocities_after() const = 0;
  /// Gravity's potential against the start [J].
  double gravity_energy() const;

  const MassSpringModel* model_;
  Vec3 gravity_;
  double step_;
  std::uint64_t n_ = 0;
  // Where steps of this length began.
  std::uint64_t start_n_ = 0;
  double start_time_ = 0;  // [s]
  std::vector<Vec3> x_;
  ContactPoints points_;
  ContactFinder finder_;
  std::vector<Contact> contacts_;
  TunnelWatch walls_;
  std::optional<double> first_contact_;  // [s]

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
  /// Goes the way to x_{n+1}.
  virtual void commit() = 0;
};

struct StepperOptions {
  Integrator integrator = Integrator::symplectic_euler;
  SolverOptions solver = {};
  bool ledger = true;  ///< keep account of the losses
  /// Where the body touches obstacles; none: at its nodes.
  std::shared_ptr<const ContactSkin> skin = nullptr;
};

}  // namespace springlod::sim
