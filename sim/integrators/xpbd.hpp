#pragma once

#include <vector>

#include "sim/integrators/implicit_springs.hpp"
#include "sim/integrators/whole_step.hpp"

namespace springlod::sim {

/// Extended position based dynamics (Macklin, Mueller, Chentanez 2016): springs as constraints
/// l = L' of compliance 1/k', contacts as unilateral constraints, solved one after another in the
/// model's order (Gauss-Seidel). It takes one sweep and small steps instead of many sweeps (Macklin
/// et al. 2019). If it is iterated to convergence, it is backward Euler; with fewer sweeps, bodies
/// are softer, and the effect grows with the stiffness of the springs.
class Xpbd final : public WholeStep {
 public:
  Xpbd(const MassSpringModel& model, const Scenario& scenario, const State& start, double step,
       const StepperOptions& options);

 private:
  void solve() override;
  void sweep_springs();
  void sweep_anchors();
  void sweep_contacts();

  ImplicitSprings springs_;
  std::uint32_t sweeps_;
  std::vector<double> inverse_mass_;        // 0 for held nodes [1/kg]
  std::vector<double> multiplier_;          // of springs [N s2]
  std::vector<Vec3> anchor_multiplier_;     // of springs of anchors [N s2]
  std::vector<Contact> candidates_;         // found at the end of the step without forces ...
  std::vector<Vec3> found_at_;              // ... and the positions of their nodes there [m]
  std::vector<double> contact_multiplier_;  // [N s2] >= 0
};

}  // namespace springlod::sim
