#include "lod/merging/rigidity.hpp"

#include <Eigen/Eigenvalues>

namespace springlod::lod {
namespace {

// The closed-form eigenvalues have an error of up to about 1e-8 of the trace where two coincide,
// the square root of the rounding. Nodes within this margin of the bound are decided by the
// eigenvalues.
constexpr double kRoundingMargin = 1e-6;

}  // namespace

// Sufficient condition from the determinant and the trace t: the product of the two larger
// eigenvalues is at most t^2 / 4, so lambda_min >= 4 det / t^2, and lambda_max <= t. Nearly all
// nodes pass, which saves the eigenvalues.
bool Rigidity::surely_at_least(double ratio) const {
  const double trace = xx_ + yy_ + zz_;
  const double det =
      xx_ * (yy_ * zz_ - zy_ * zy_) - yx_ * (yx_ * zz_ - zy_ * zx_) + zx_ * (yx_ * zy_ - yy_ * zx_);
  return det > (ratio / 4 + kRoundingMargin) * (trace * trace * trace);
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
