#pragma once

#include <cstdint>
#include <vector>

#include <Eigen/Core>

#include "lod/options.hpp"
#include "model/mass_spring.hpp"

namespace springlod::lod {

/// Keeps total mass, centre of mass and second moments (ten numbers) while masses shift between
/// nodes: those of the body, or those of each material region of at least 20 nodes and of all
/// smaller regions together (docs/method.md, eqs. 35 and 36).
class MassMoments {
 public:
  explicit MassMoments(const MassSpringModel& model, KeptMoments kept = KeptMoments::body);

  /// Projects each column of `changes` of ln m, N rows [1], onto the changes that keep the moments
  /// to first order.
  void project(const std::vector<double>& mass, Eigen::Ref<Eigen::MatrixXd> changes) const;

  /// Restores the moments to rounding: multiplies the masses, N [kg], by a quadratic polynomial of
  /// the position, one for the body or one for each region.
  void restore(std::vector<double>& mass) const;

 private:
  using Moments = Eigen::Matrix<double, 10, 1>;
  struct Piece {
    std::vector<std::uint32_t> nodes;
    Moments target = Moments::Zero();
  };

  void restore(const Piece& piece, std::vector<double>& mass) const;

  std::vector<Moments> monomials_;  // 1, x, y, z, xx, ... of each node, in half-diagonals
  std::vector<Piece> pieces_;       // each node is in one
};

}  // namespace springlod::lod
