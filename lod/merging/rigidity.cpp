#include "lod/merging/rigidity.hpp"

#include <Eigen/Eigenvalues>

namespace springlod::lod {
namespace {

// The closed form of the eigenvalues is off by up to some 1e-8 of the trace (a root of the
// rounding, where two coincide); what lies closer to the limit than this is left to it.
constexpr double kRoundingMargin = 1e-6;

}  // namespace

// From the determinant and the trace t alone: the two larger eigenvalues have a product of at most
// t^2 / 4, so that lambda_min >= 4 det / t^2, and lambda_max <= t. Nearly all nodes pass, without
// the eigenvalues being found.
bool Rigidity::surely_at_least(double ratio) const {
  const double trace = xx_ + yy_ + zz_;
  const double det =
      xx_ * (yy_ * zz_ - zy_ * zy_) - yx_ * (yx_ * zz_ - zy_ * zx_) + zx_ * (yx_ * zy_ - yy_ * zx_);
  return det > (ratio / 2 + kRoundingMargin) * (trace * trace * trace);
}

bool Rigidity::at_least(double ratio) const {
  if (surely_at_least(ratio)) return true;
  Mat3 tensor;
  tensor << xx_, yx_, zx_, yx_, yy_, zy_, zx_, zy_, zz_;
  Eigen::SelfAdjointEigenSolver<Mat3> solver;
  solver.computeDirect(tensor, Eigen::EigenvaluesOnly);
  return solver.eigenvalues()[0] >= ratio * solver.eigenvalues()[2];
}

}  // namespace springlod::lod
