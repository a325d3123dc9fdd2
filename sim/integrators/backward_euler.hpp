#pragma once

#include <memory>
#include <vector>

#include <Eigen/SparseCore>

#include "sim/integrators/implicit_springs.hpp"
#include "sim/integrators/whole_step.hpp"

namespace springlod::sim {

/// Backward Euler: x_{n+1} is the minimum of
///
///   sum m |x - x_n - dt v_n - dt^2 g|^2 / (2 dt^2) + elastic + damping + contact energy,
///
/// found by Newton's method with a line search. Each spring gives k' u u^T + k' max(0, 1 - L'/l)
/// (1 - u u^T) to the matrix: the part that compression makes negative is left out, so that the
/// matrix stays positive definite (as in Teran et al. 2005, and exact for springs).
/// Unconditionally stable; it takes energy from whatever swings faster than the step sees.
class BackwardEuler final : public WholeStep {
 public:
  BackwardEuler(const MassSpringModel& model, const Scenario& scenario, const State& start,
                double step, const StepperOptions& options);
  ~BackwardEuler() override;
  std::uint64_t unconverged_steps() const override { return unconverged_steps_; }

  /// Solves H d = g for the lower half of a symmetric matrix.
  class LinearSolver {
   public:
    virtual ~LinearSolver() = default;
    virtual Eigen::VectorXd solve(const Eigen::SparseMatrix<double>& matrix,
                                  const Eigen::VectorXd& right) = 0;
    /// Passes over the springs that the last solution took.
    virtual std::uint64_t passes() const = 0;
    /// Whether the last solution is as exact as it should be.
    virtual bool converged() const = 0;
  };

 private:
  void solve() override;
  /// What is minimised at x; leaves the contacts there in trial_contacts_.
  double energy(const std::vector<Vec3>& x);
  /// Its gradient into gradient_ and its matrix into matrix_, with trial_contacts_ of x.
  void linearise(const std::vector<Vec3>& x);
  /// A point that several nodes carry joins these, in the matrix by a bound on the diagonal alone:
  /// that keeps its pattern, and costs Newton's method some iterations.
  void add_contact(const Contact& contact);
  void make_pattern();
  void add_to_diagonal(std::uint32_t node, const Mat3& block);
  /// Goes from x_next_ against the gradient; false if that brings nothing any more.
  bool descend();
  /// Newton's method from x_next_; whether it came to an end: forces within the tolerance of
  /// `scale` [N], or no descent left although the linear system was solved (rounding).
  bool minimise(double scale);

  ImplicitSprings springs_;
  std::uint32_t iterations_;
  double tolerance_;
  std::unique_ptr<LinearSolver> solver_;
  Eigen::SparseMatrix<double> matrix_;  // lower half, 3N x 3N
  Eigen::VectorXd gradient_;
  std::vector<Vec3> free_, trial_, trial_velocity_;
  std::vector<Contact> trial_contacts_;
  double energy_ = 0;
  std::uint64_t unconverged_steps_ = 0;
  bool gave_up_ = false;  // on the step worked out last, which may yet be taken
};

}  // namespace springlod::sim
