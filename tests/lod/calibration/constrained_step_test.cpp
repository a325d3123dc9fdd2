#include "lod/calibration/constrained_step.hpp"

#include <catch2/catch.hpp>

#include "elastic/solver/random_block.hpp"
#include "lod/calibration/frequency_constraints.hpp"
#include "tests/support/bodies.hpp"

using namespace springlod;
using namespace springlod::lod;

namespace {

constexpr Eigen::Index kResiduals = 12;

/// Random linear residuals of the bodies' springs, with a bound that a third of them exceeds.
struct Problem {
  MassSpringModel model = test::rods();
  LevelVariables variables{model, {}};
  Eigen::VectorXd theta = Eigen::VectorXd::Zero(variables.count());
  Eigen::MatrixXd jacobian = 0.05 * elastic::random_block(variables.count(), kResiduals, 1);
  Eigen::MatrixXd normal = jacobian.transpose() * jacobian;
  Eigen::VectorXd residual = 0.1 * elastic::random_block(kResiduals, 1, 2);

  ConstrainedProblem with_bound(double factor) const {
    return {.variables = variables,
            .theta = theta,
            .residual = residual,
            .jacobian = jacobian,
            .normal = normal,
            .bound = factor * largest_node_bound(model),
            .constraint_weight = 0.5};
  }
  double objective(const ConstrainedProblem& problem, const Eigen::VectorXd& d) const {
    return (residual - jacobian.transpose() * d).squaredNorm() +
           0.25 * squared_violation(variables.model(theta + d), problem.bound);
  }
};

}  // namespace

TEST_CASE("Without active constraints a step removes the residuals as far as its damping lets it") {
  const Problem random;
  const ConstrainedProblem problem = random.with_bound(100);
  double damping = 1e-4;
  const ConstrainedStep step = constrained_step(problem, damping);
  const double before = random.residual.squaredNorm();
  CHECK(random.objective(problem, step.change) < 1e-3 * before);
  CHECK(step.predicted == Approx(before - random.objective(problem, step.change)));
}

TEST_CASE("A step lowers residuals and violated constraints together, as it predicts") {
  const Problem random;
  for (const double factor : {0.9, 0.7, 0.5}) {
    INFO("bound of " << factor);
    const ConstrainedProblem problem = random.with_bound(factor);
    double damping = 1e-3;
    const ConstrainedStep step = constrained_step(problem, damping);
    const double before = random.objective(problem, random.theta);
    const double after = random.objective(problem, step.change);
    CHECK(after < 0.7 * before);
    CHECK(step.predicted == Approx(before - after));
  }
}

TEST_CASE("A step does not run into constraints that are far away at its start") {
  Problem rising;
  // The residual falls as all springs become stiffer.
  rising.jacobian.setConstant(0.01);
  rising.normal = rising.jacobian.transpose() * rising.jacobian;
  rising.residual.setConstant(10);
  const auto violation = [&](double factor) {
    ConstrainedProblem problem = rising.with_bound(factor);
    problem.constraint_weight = 50;
    double damping = 1e-6;
    const ConstrainedStep step = constrained_step(problem, damping);
    return squared_violation(rising.variables.model(step.change), rising.with_bound(1.05).bound);
  };
  const double unbounded = violation(100), bounded = violation(1.05);
  CHECK(bounded < 0.1 * unbounded);
}

TEST_CASE("The problem is convex: no point between a step and the start is better") {
  const Problem random;
  const ConstrainedProblem problem = random.with_bound(0.7);
  double damping = 1e-3;
  const ConstrainedStep step = constrained_step(problem, damping);
  const double after = random.objective(problem, step.change);
  for (const double part : {0.2, 0.5, 0.8})
    CHECK(random.objective(problem, part * step.change) > after);
}
