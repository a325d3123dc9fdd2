#include "sim/integrators/backward_euler.hpp"

#include <algorithm>
#include <cmath>

#include <Eigen/IterativeLinearSolvers>
#include <Eigen/SparseCholesky>

namespace springlod::sim {
namespace {

using Matrix = Eigen::SparseMatrix<double>;

// Newton's direction need not be exact: this is the relative residual tolerance of its linear
// system [1].
constexpr double kLinearTolerance = 1e-3;

class GradientSolver final : public BackwardEuler::LinearSolver {
 public:
  explicit GradientSolver(std::uint32_t iterations) {
    solver_.setTolerance(kLinearTolerance);
    if (iterations > 0) solver_.setMaxIterations(iterations);
  }
  Eigen::VectorXd solve(const Matrix& matrix, const Eigen::VectorXd& right) override {
    solver_.compute(matrix);
    Eigen::VectorXd x = solver_.solve(right);
    passes_ = static_cast<std::uint64_t>(solver_.iterations());
    return x;
  }
  std::uint64_t passes() const override { return passes_; }
  bool converged() const override { return solver_.info() == Eigen::Success; }

 private:
  Eigen::ConjugateGradient<Matrix, Eigen::Lower> solver_;  // preconditioned by the diagonal
  std::uint64_t passes_ = 0;
};

class FactorSolver final : public BackwardEuler::LinearSolver {
 public:
  Eigen::VectorXd solve(const Matrix& matrix, const Eigen::VectorXd& right) override {
    if (!analysed_) factor_.analyzePattern(matrix);
    analysed_ = true;
    factor_.factorize(matrix);
    return factor_.solve(right);
  }
  std::uint64_t passes() const override { return 1; }
  bool converged() const override { return factor_.info() == Eigen::Success; }

 private:
  Eigen::SimplicialLDLT<Matrix, Eigen::Lower> factor_;
  bool analysed_ = false;
};

Eigen::Index row_of(std::uint32_t node) {
  return 3 * static_cast<Eigen::Index>(node);
}

}  // namespace

BackwardEuler::BackwardEuler(const MassSpringModel& model, const Scenario& scenario,
                             const State& start, double step, const StepperOptions& options)
    : WholeStep(model, scenario, start, step, options),
      springs_(model, step),
      iterations_(iterations_of(options.integrator, options.solver)),
      tolerance_(options.solver.tolerance),
      free_(start.x),
      trial_(start.x),
      trial_velocity_(start.v) {
  if (options.integrator == Integrator::backward_euler_direct)
    solver_ = std::make_unique<FactorSolver>();
  else
    solver_ = std::make_unique<GradientSolver>(options.solver.linear_iterations);
  make_pattern();
}

BackwardEuler::~BackwardEuler() = default;

// Column 3a + d holds rows 3a + d .. 3a + 2, then rows 3b .. 3b + 2 of every spring (a, b) in the
// model's order, which is that of ascending b.
void BackwardEuler::make_pattern() {
  const Eigen::Index size = 3 * static_cast<Eigen::Index>(model_->node_count());
  std::vector<int> per_column(static_cast<std::size_t>(size));
  for (std::size_t i = 0; i < per_column.size(); ++i) per_column[i] = static_cast<int>(3 - i % 3);
  for (const std::uint32_t a : model_->a)
    for (std::size_t d = 0; d < 3; ++d) per_column[std::size_t{3} * a + d] += 3;
  matrix_.resize(size, size);
  matrix_.reserve(per_column);
  for (Eigen::Index i = 0; i < size; ++i)
    for (Eigen::Index row = i; row < i / 3 * 3 + 3; ++row) matrix_.insert(row, i) = 0;
  for (std::uint32_t s = 0; s < model_->spring_count(); ++s)
    for (Eigen::Index d = 0; d < 3; ++d)
      for (Eigen::Index row = 0; row < 3; ++row)
        matrix_.insert(3 * static_cast<Eigen::Index>(model_->b[s]) + row,
                       3 * static_cast<Eigen::Index>(model_->a[s]) + d) = 0;
  matrix_.makeCompressed();
}

void BackwardEuler::add_to_diagonal(std::uint32_t node, const Mat3& block) {
  for (int d = 0; d < 3; ++d) {
    double* column = matrix_.valuePtr() + matrix_.outerIndexPtr()[row_of(node) + d];
    for (int row = d; row < 3; ++row) column[row - d] += block(row, d);
  }
}

double BackwardEuler::energy(const std::vector<Vec3>& x) {
  double energy = springs_.energy(x) + implicit_anchors_.energy(x);
  for (std::size_t i = 0; i < x.size(); ++i) {
    energy += model_->mass[i] * (x[i] - free_[i]).squaredNorm() / (2 * step_ * step_);
    trial_velocity_[i] = (x[i] - x_[i]) / step_;
  }
  ContactFinder finder = finder_;  // a trial must not change the side from which a node came
  finder.find(x, trial_velocity_, x_, trial_contacts_);
  for (const Contact& c : trial_contacts_)
    energy += c.normal_force * c.normal_force / (2 * c.implicit_stiffness(step_));
  spring_updates_ += model_->spring_count();
  return energy;
}

void BackwardEuler::linearise(const std::vector<Vec3>& x) {
  std::fill(matrix_.valuePtr(), matrix_.valuePtr() + matrix_.nonZeros(), 0.0);
  for (std::uint32_t i = 0; i < model_->node_count(); ++i) {
    const double inertia = model_->mass[i] / (step_ * step_);
    gradient_.segment<3>(row_of(i)) = inertia * (x[i] - free_[i]);
    add_to_diagonal(i, inertia * Mat3::Identity());
  }
  std::ptrdiff_t place = 0;  // of the spring among those of its a
  for (std::uint32_t s = 0; s < model_->spring_count(); ++s) {
    const std::uint32_t a = model_->a[s];
    const std::uint32_t b = model_->b[s];
    place = s > 0 && model_->a[s - 1] == a ? place + 1 : 0;
    const auto [unit, length] = spring_axis(*model_, s, x);
    const double k = springs_.stiffness(s);
    const double stretch = length - springs_.rest_length(s);
    const double across = stretch > 0 ? k * stretch / length : 0;
    const Mat3 block = (k - across) * unit * unit.transpose() + across * Mat3::Identity();
    gradient_.segment<3>(row_of(a)) -= k * stretch * unit;
    gradient_.segment<3>(row_of(b)) += k * stretch * unit;
    add_to_diagonal(a, block);
    add_to_diagonal(b, block);
    if (held_.holds(a) || held_.holds(b)) continue;
    for (int d = 0; d < 3; ++d) {
      double* column =
          matrix_.valuePtr() + matrix_.outerIndexPtr()[row_of(a) + d] + (3 - d) + 3 * place;
      for (int row = 0; row < 3; ++row) column[row] -= block(row, d);
    }
  }
  for (std::uint32_t s = 0; s < implicit_anchors_.count(); ++s) {
    const std::uint32_t i = implicit_anchors_.node(s);
    const double k = implicit_anchors_.stiffness(s);
    gradient_.segment<3>(row_of(i)) += k * (x[i] - implicit_anchors_.place(s));
    add_to_diagonal(i, k * Mat3::Identity());
  }
  for (const Contact& c : trial_contacts_) add_contact(c);
  fix_held();
}

void BackwardEuler::fix_held() {
  for (const std::uint32_t node : held_.nodes()) gradient_.segment<3>(row_of(node)).setZero();
}

void BackwardEuler::add_contact(const Contact& contact) {
  const double reach = points_.reach(contact.point);
  for (const ContactPoints::Share& share : points_.shares(contact.point)) {
    gradient_.segment<3>(row_of(share.node)) -=
        share.weight * contact.normal_force * contact.normal;
    if (contact.normal_force > 0)
      add_to_diagonal(share.node, std::abs(share.weight) * reach *
                                      contact.implicit_stiffness(step_) * contact.normal *
                                      contact.normal.transpose());
  }
}

bool BackwardEuler::descend() {
  constexpr double kSufficient = 1e-4;  // Armijo constant: fraction of the directional derivative
  constexpr int kHalvings = 20;         // of Newton's step: below it, rounding errors dominate
  const Eigen::VectorXd direction = solver_->solve(matrix_, -gradient_);
  spring_updates_ += solver_->passes() * model_->spring_count();
  const double slope = gradient_.dot(direction);
  if (!(slope < 0)) return false;
  double part = 1;
  for (int halving = 0; halving < kHalvings; ++halving, part /= 2) {
    for (std::uint32_t i = 0; i < model_->node_count(); ++i)
      trial_[i] = x_next_[i] + part * direction.segment<3>(row_of(i));
    const double reached = energy(trial_);
    if (reached <= energy_ + kSufficient * part * slope) {
      energy_ = reached;
      x_next_.swap(trial_);
      return true;
    }
  }
  return false;
}

void BackwardEuler::solve() {
  springs_.begin_step(x_);
  double scale = 0;  // of the acting forces [N]
  for (std::uint32_t i = 0; i < x_.size(); ++i) {
    free_[i] = x_[i] + step_ * (v_[i] + step_ * gravity_);
    x_next_[i] = x_[i] + step_ * v_[i];
    if (held_.holds(i)) continue;
    const double inertia = model_->mass[i] * (v_[i].norm() / step_ + gravity_.norm());
    scale += inertia * inertia;
  }
  hold_nodes();
  held_.put(free_);
  gradient_.resize(3 * static_cast<Eigen::Index>(x_.size()));
  energy_ = energy(x_next_);
  if (gave_up_) ++unconverged_steps_;
  gave_up_ = !minimise(std::sqrt(scale));
  finish_implicit(springs_);
}

bool BackwardEuler::minimise(double scale) {
  for (std::uint32_t iteration = 0;; ++iteration) {
    linearise(x_next_);
    if (iteration == 0) scale = std::max(scale, gradient_.norm());
    if (gradient_.norm() <= tolerance_ * scale) return true;
    if (iteration == iterations_) return false;
    if (!descend()) return solver_->converged();
  }
}

}  // namespace springlod::sim
