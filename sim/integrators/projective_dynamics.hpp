#pragma once

#include <vector>

#include <Eigen/SparseCholesky>
#include <Eigen/SparseCore>

#include "sim/integrators/implicit_springs.hpp"
#include "sim/integrators/whole_step.hpp"

namespace springlod::sim {

/// Projective dynamics (Bouaziz et al. 2014; Liu et al. 2013 for springs): solves backward Euler by
/// alternating two steps. The local step gives every spring its target length in its present
/// direction. The global step solves a system with the constant matrix M/dt^2 + sum k' over springs
/// (N x N, factorized once, and again when the set of touching nodes changes). If it is stopped
/// before convergence, bodies with large stiffness ratios are too soft, and rotation is damped.
class ProjectiveDynamics final : public WholeStep {
 public:
  ProjectiveDynamics(const MassSpringModel& model, const Scenario& scenario, const State& start,
                     double step, const StepperOptions& options);

 private:
  using Matrix = Eigen::SparseMatrix<double>;
  using Columns = Eigen::Matrix<double, Eigen::Dynamic, 3>;

  void solve() override;
  void make_matrix();
  /// Adds the contacts at x_next_ to the matrix; factorizes it again if they changed.
  void take_contacts();
  /// Stiffness of a contact at one of the nodes from which its point is interpolated [N/m].
  double held_by(const Contact& contact, const ContactPoints::Share& share) const;
  void global_step();
  void pull_from_held();

  ImplicitSprings springs_;
  std::uint32_t iterations_;
  Matrix matrix_;                 // lower half, without contacts
  std::vector<double> touching_;  // contact stiffness in the factor, by node [N/m]
  Eigen::SimplicialLDLT<Matrix, Eigen::Lower> factor_;
  bool factorized_ = false;
  std::vector<Vec3> free_;
  std::vector<Contact> trial_contacts_;
  Columns right_;
};

}  // namespace springlod::sim
