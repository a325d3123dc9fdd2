#pragma once

#include <Eigen/Core>

#include "lod/calibration/level_variables.hpp"
#include "lod/options.hpp"

namespace springlod::lod {

/// Residuals of a level linearized at theta, with the bound on its node frequencies as it is
/// (docs/method.md, eqs. 39 and 42a):
///   F(theta + d) ~ |G^T d - r|^2 + chi^2 sum_i max(0, h_i(theta + d))^2.
struct ConstrainedProblem {
  const LevelVariables& variables;
  const Eigen::VectorXd& theta;
  const Eigen::VectorXd& residual;  ///< r, R
  const Eigen::MatrixXd& jacobian;  ///< G: see StepProblem
  const Eigen::MatrixXd& normal;    ///< G^T G
  NodeMasses masses = NodeMasses::group;
  double bound = 0;              ///< tau of h [rad2/s2]
  double constraint_weight = 1;  ///< chi
};

struct ConstrainedStep {
  Eigen::VectorXd change;  ///< d
  double predicted = 0;    ///< decrease of F by the problem [1]
};

/// Levenberg-Marquardt step for the problem: damped_step with the constraints linearized again and
/// again along the step. Each linearization is searched along, so that F, with the damping term,
/// falls each time. `damping`: as in damped_step.
ConstrainedStep constrained_step(const ConstrainedProblem& problem, double& damping);

}  // namespace springlod::lod
