#pragma once

#include <cstdint>
#include <vector>

#include <Eigen/Core>

#include "lod/options.hpp"
#include "model/mass_spring.hpp"

namespace springlod::lod {

/// Total mass, centre of mass and second moments of a model, ten numbers, or of each of its pieces
/// and of what is left, to be kept while masses shift between its nodes.
class MassMoments {
 public:
  explicit MassMoments(const MassSpringModel& model, KeptMoments kept = KeptMoments::body);

  /// Takes out of each column of changes of ln m [1], N rows, what would change the moments to
  /// first order.
  void project(const std::vector<double>& mass, Eigen::Ref<Eigen::MatrixXd> changes) const;

  /// Brings the moments back to what they were, exactly but for rounding: each mass times a
  /// polynomial of second order in the place, one for all or one a piece.
  void restore(std::vector<double>& mass) const;

 private:
  using Moments = Eigen::Matrix<double, 10, 1>;
  struct Piece {
    std::vector<std::uint32_t> nodes;
    Moments wanted = Moments::Zero();
  };

  void restore(const Piece& piece, std::vector<double>& mass) const;

  std::vector<Moments> monomials_;  // 1, x, y, z, xx, ... of each node, scaled to the body's size
  std::vector<Piece> pieces_;       // every node is in one
};

}  // namespace springlod::lod
