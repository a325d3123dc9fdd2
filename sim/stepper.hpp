#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "model/mass_spring.hpp"
#include "sim/contact.hpp"
#include "sim/integrator.hpp"
#include "sim/ledger.hpp"
#include "sim/scenario.hpp"

namespace springlod {

/// One scheme at work on one body, step by step, as `run` drives it:
///
///   prepare(); { look at step n; commit(); prepare(); } ...
///
/// prepare() works out the way to x_{n+1}, commit() goes it. Between the two everything below is
/// valid and speaks of the time t_n = n dt. Model and scenario must outlive the stepper.
class Stepper {
 public:
  virtual ~Stepper() = default;
  Stepper(const Stepper&) = delete;
  Stepper& operator=(const Stepper&) = delete;

  virtual void prepare() = 0;
  virtual void commit() = 0;

  std::uint64_t step_number() const { return n_; }
  double time() const { return static_cast<double>(n_) * step_; }
  /// Springs evaluated so far, every one of every iteration counted: the deterministic cost.
  virtual std::uint64_t spring_updates() const = 0;
  /// Steps whose solver used up its iterations short of its tolerance. Schemes that take a fixed
  /// number of iterations promise no tolerance and have none.
  virtual std::uint64_t unconverged_steps() const { return 0; }

  const std::vector<Vec3>& positions() const { return x_; }
  const std::vector<Contact>& contacts() const { return contacts_; }
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
  Stepper(const MassSpringModel& model, const Scenario& scenario, const State& start, double step);

  /// The velocities with which the body goes on from x_n.
  virtual const std::vector<Vec3>& velocities_after() const = 0;
  /// Gravity's potential against the start [J].
  double gravity_energy() const;

  const MassSpringModel* model_;
  Vec3 gravity_;
  double step_;
  std::uint64_t n_ = 0;
  std::vector<Vec3> x_;
  ContactFinder finder_;
  std::vector<Contact> contacts_;

 private:
  double total_mass_ = 0;
  Vec3 first_center_;
};

struct StepperOptions {
  Integrator integrator = Integrator::symplectic_euler;
  SolverOptions solver = {};
  bool ledger = true;  ///< keep account of the losses
};

std::unique_ptr<Stepper> make_stepper(const MassSpringModel& model, const Scenario& scenario,
                                      const State& start, double step,
                                      const StepperOptions& options);

}  // namespace springlod
