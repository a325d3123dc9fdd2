#pragma once

#include <vector>

#include <Eigen/Core>

#include "model/mass_spring.hpp"

namespace springlod {

/// Total mass, centre of mass and second moments of a model, ten numbers, to be kept while masses
/// shift between its nodes.
class MassMoments {
 public:
  explicit MassMoments(const MassSpringModel& model);

  /// Takes out of each column of changes of ln m [1], N rows, what would change the moments to
  /// first order.
  void project(const std::vector<double>& mass, Eigen::Ref<Eigen::MatrixXd> changes) const;

  /// Brings the moments back to what they were, exactly but for rounding: each mass times one
  /// polynomial of second order in the place.
  void restore(std::vector<double>& mass) const;

 private:
  using Moments = Eigen::Matrix<double, 10, 1>;
  std::vector<Moments> monomials_;  // 1, x, y, z, xx, ... of each node, scaled to the body's size
  Moments wanted_ = Moments::Zero();
};

}  // namespace springlod
