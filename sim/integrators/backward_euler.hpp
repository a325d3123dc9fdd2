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
/// found by Newton's method with a line search. Each spring contributes k' u u^T + k' max(0, 1 -
/// L'/l) (1 - u u^T) to the matrix. The term that is negative under compression is clamped to 0,
/// which keeps the matrix positive definite (Teran et al. 2005; for springs the projection is
/// exact). Unconditionally stable; it damps vibrations that the step does not resolve.
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
    /// True if the last solution is within the tolerance.
    virtual bool converged() const = 0;
  };

 private:
  void solve() override;
  /// The minimised function at x; stores the contacts at x in trial_contacts_.
  double energy(const std::vector<Vec3>& x);
  /// Writes its gradient to gradient_ and its Hessian to matrix_. Needs the trial_contacts_ of x.
  void linearise(const std::vector<Vec3>& x);
  /// A point interpolated from several nodes couples these nodes. In the matrix, the coupling is
  /// replaced by a bound on the diagonal. This keeps the sparsity pattern, but Newton's method
  /// needs some more iterations.
  void add_contact(const Contact& contact);
  /// Leaves the held nodes where they are in a Newton iteration.
  void fix_held();
  void make_pattern();
  void add_to_diagonal(std::uint32_t node, const Mat3& block);
  /// Gradient descent from x_next_; false if it no longer decreases the function.
  bool descend();
  /// Newton's method from x_next_. Returns true if it converged: the forces are within the
  /// tolerance times `scale` [N], or no descent is possible although the linear system was solved
  /// (rounding).
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
  bool gave_up_ = false;  // for the step computed last, which may still be taken
};

}  // namespace springlod::sim
