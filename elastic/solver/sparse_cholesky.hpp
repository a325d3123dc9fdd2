#pragma once

#include <cstdint>
#include <vector>

#include <Eigen/Core>
#include <Eigen/SparseCore>

#include "base/progress.hpp"
#include "elastic/solver/dissection.hpp"

namespace springlod::elastic {

/// Which nodes a 3N x 3N matrix couples (rows 3i..3i+2 belong to node i).
NodeGraph node_graph(const Eigen::SparseMatrix<double>& matrix);

/// Cholesky factors A = L L^T of a symmetric positive definite matrix of 3 x 3 blocks, one row of
/// blocks a node. Multifrontal (Duff & Reid 1983) on the tree of a dissection: each piece is one
/// dense block of columns, so that nearly all the work is done by dense kernels.
///
/// One thread; the same bits every time.
class SparseCholesky {
 public:
  /// Both halves of the matrix must be stored. `points` are the N places of the nodes, by which the
  /// order of elimination is chosen.
  SparseCholesky(const Eigen::SparseMatrix<double>& matrix, const std::vector<Vec3>& points,
                 Progress* progress = nullptr);

  /// False if a pivot was not positive: the matrix is not positive definite, as far as rounding
  /// tells. Then there is nothing to solve with.
  bool positive() const { return positive_; }
  /// x = A^-1 b for each column of b (3N rows).
  Eigen::MatrixXd solve(const Eigen::MatrixXd& b) const;
  /// Numbers stored in L, zeros within its dense blocks included.
  std::size_t stored() const;

 private:
  /// Columns of one piece: a dense block, its own rows first, then those of nodes further up.
  struct Front {
    Eigen::Index first = 0;           // unknown, in the order of elimination
    std::vector<std::uint32_t> rows;  // nodes further up, by their place in the order; rising
    std::uint32_t parent = Dissection::kNoParent;
    Eigen::MatrixXd block;
    Eigen::Index width() const { return block.cols(); }
    Eigen::Index below() const { return block.rows() - block.cols(); }
  };
  class Builder;

  std::vector<std::uint32_t> order_;
  std::vector<Front> fronts_;
  bool positive_ = true;
};

}  // namespace springlod::elastic
