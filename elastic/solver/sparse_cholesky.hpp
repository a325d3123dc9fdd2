#pragma once

#include <cstdint>
#include <vector>

#include <Eigen/Core>
#include <Eigen/SparseCore>

#include "base/progress.hpp"
#include "elastic/solver/dissection.hpp"

namespace springlod::elastic {

/// Graph of the nodes that a 3N x 3N matrix couples (rows 3i..3i+2 belong to node i).
NodeGraph node_graph(const Eigen::SparseMatrix<double>& matrix);

/// Cholesky factors A = L L^T of a symmetric positive definite matrix of 3 x 3 blocks, one row of
/// blocks for each node. Multifrontal (Duff & Reid 1983) on the tree of a dissection: each
/// supernode is one dense block of columns, so dense kernels do nearly all the work.
///
/// One thread; the same bits every time.
class SparseCholesky {
 public:
  /// Both triangles of the matrix must be stored. `points`: positions of the N nodes, which
  /// determine the order of elimination.
  SparseCholesky(const Eigen::SparseMatrix<double>& matrix, const std::vector<Vec3>& points,
                 Progress* progress = nullptr);

  /// False if a pivot was not positive: the matrix is not positive definite, up to rounding.
  /// solve() must not be called then.
  bool positive() const { return positive_; }
  /// x = A^-1 b for each column of b (3N rows).
  Eigen::MatrixXd solve(const Eigen::MatrixXd& b) const;

 private:
  /// Columns of one supernode: a dense block, first its own rows, then those of its ancestors.
  struct Front {
    Eigen::Index first = 0;  // its first unknown, in the order of elimination
    std::vector<std::uint32_t>
        rows;  // nodes of its ancestors, by their place in the order; ascending
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
