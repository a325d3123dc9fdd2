#pragma once

#include <cstdint>
#include <vector>

#include "sim/integrators/implicit_springs.hpp"
#include "sim/integrators/stepper.hpp"

namespace springlod::sim {

/// Schemes that keep positions and velocities at the same instants. What a scheme does is solve();
/// friction comes after it, as a cap on slip. In the implicit schemes, whose steps are long, it
/// also takes back the way slipped too far.
///
/// Its ledger holds the true energies of (x_n, v_n) and the work of each dissipative force as the
/// scheme sees it. What a scheme gains or loses by itself is in no entry: it shows as the drift of
/// the total.
class WholeStep : public StepByStep {
 public:
  void prepare() final;

  std::uint64_t spring_updates() const final { return spring_updates_; }
  /// On the straight line from x_n to x_{n+1}.
  std::vector<Vec3> positions_at(double time) const final;
  State state() const final { return {x_, v_, time()}; }
  LedgerEntry ledger_entry() const final;

 protected:
  WholeStep(const MassSpringModel& model, const Scenario& scenario, const State& start, double step,
            const StepperOptions& options);

  /// From x_ and v_ to x_next_ and v_next_, without friction. Adds to spring_updates_ and, with a
  /// ledger, to lost_damping_.
  virtual void solve() = 0;
  /// How every implicit scheme ends its solve(): v_next_ is that of the way to x_next_, on which
  /// damping takes its part.
  void finish_implicit(const ImplicitSprings& springs);

  bool with_ledger_;
  std::vector<Vec3> v_;                // at x_
  std::vector<Vec3> x_next_, v_next_;  // of the step that prepare() worked out
  std::uint64_t spring_updates_ = 0;
  double lost_damping_ = 0;  // [J]

 private:
  void commit() final;
  const std::vector<Vec3>& velocities_after() const final { return v_next_; }
  void add_friction();

  bool friction_moves_;
  std::vector<Contact> next_contacts_;
  // Losses on the way to x_{n+1}, which count from there on.
  LedgerEntry losses_, next_losses_;
};

}  // namespace springlod::sim
