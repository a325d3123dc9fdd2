#pragma once

#include <vector>

#include <Eigen/SparseCholesky>
#include <Eigen/SparseCore>

#include "sim/integrators/implicit_springs.hpp"
#include "sim/integrators/whole_step.hpp"

namespace springlod::sim {

/// Projective dynamics (Bouaziz et al. 2014; Liu et al. 2013 for springs): backward Euler by turns
/// of a local step, where every spring takes its wanted length in its present direction, and a
/// global one with the constant matrix M/dt^2 + sum k' over springs (N x N, factorized once, and
/// again when other nodes come to touch). Cut short it is too soft where stiffnesses differ much,
/// and resists turning.
class ProjectiveDynamics final : public WholeStep {
 public:
  ProjectiveDynamics(const MassSpringModel& model, const Scenario& scenario, const State& start,
                     double step, const StepperOptions& options);

 private:
  using Matrix = Eigen::SparseMatrix<double>;
  using Columns = Eigen::Matrix<double, Eigen::Dynamic, 3>;

  void solve() override;
  void make_matrix();
  /// Makes contacts at x_next_ part of the matrix; factorizes it anew if they are others.
  void take_contacts();
  /// Stiffness by which a contact holds one of the nodes that carry its point [N/m].
  double held_by(const Contact& contact, const ContactPoints::Share& share) const;
  void global_step();

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
