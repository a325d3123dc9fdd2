#include "elastic/solver/sparse_cholesky.hpp"

#include <algorithm>
#include <cassert>
#include <utility>

#include "elastic/solver/dense_kernels.hpp"

namespace springlod::elastic {

NodeGraph node_graph(const Eigen::SparseMatrix<double>& matrix) {
  const Eigen::Index nodes = matrix.cols() / 3;
  NodeGraph graph;
  graph.start.reserve(static_cast<std::size_t>(nodes) + 1);
  graph.start.push_back(0);
  std::vector<std::uint32_t> row;
  for (Eigen::Index i = 0; i < nodes; ++i) {
    row.clear();
    for (Eigen::Index column = 3 * i; column < 3 * i + 3; ++column)
      for (Eigen::SparseMatrix<double>::InnerIterator e(matrix, column); e; ++e)
        if (e.row() / 3 != i) row.push_back(static_cast<std::uint32_t>(e.row() / 3));
    std::sort(row.begin(), row.end());
    row.erase(std::unique(row.begin(), row.end()), row.end());
    graph.neighbour.insert(graph.neighbour.end(), row.begin(), row.end());
    graph.start.push_back(static_cast<std::uint32_t>(graph.neighbour.size()));
  }
  return graph;
}

/// Fills the fronts, supernode by supernode. The Schur complement of a front (its update) is added
/// to its parent.
class SparseCholesky::Builder {
 public:
  Builder(SparseCholesky& factor, const Eigen::SparseMatrix<double>& matrix,
          const std::vector<Vec3>& points)
      : factor_(factor), matrix_(matrix), graph_(node_graph(matrix)) {
    assert(matrix.rows() == matrix.cols());
    assert(matrix.rows() == 3 * static_cast<Eigen::Index>(points.size()));
    Dissection dissection = dissect(points, graph_);
    supernodes_ = std::move(dissection.supernodes);
    factor_.order_ = std::move(dissection.order);
    place_.resize(factor_.order_.size());
    for (std::uint32_t k = 0; k < place_.size(); ++k) place_[factor_.order_[k]] = k;
    local_.resize(place_.size());
    children_.resize(supernodes_.size());
    updates_.resize(supernodes_.size());
  }

  bool run(Progress* progress) {
    Task task(progress, "factorizing the stiffness", place_.size());
    for (std::uint32_t p = 0; p < supernodes_.size(); ++p) {
      start_front(p);
      add_matrix(p);
      for (const std::uint32_t child : children_[p]) add_update(p, child);
      if (!eliminate(p)) return false;
      task.advance(supernodes_[p].end - supernodes_[p].begin);
    }
    return true;
  }

 private:
  void start_front(std::uint32_t p) {
    const Dissection::Supernode& supernode = supernodes_[p];
    Front& front = factor_.fronts_.emplace_back();
    front.first = 3 * static_cast<Eigen::Index>(supernode.begin);
    if (supernode.parent != Dissection::kNoParent) children_[supernode.parent].push_back(p);

    std::vector<std::uint32_t>& rows = front.rows;
    for (std::uint32_t k = supernode.begin; k < supernode.end; ++k) {
      const std::uint32_t node = factor_.order_[k];
      for (std::uint32_t e = graph_.start[node]; e < graph_.start[node + 1]; ++e)
        rows.push_back(place_[graph_.neighbour[e]]);
    }
    for (const std::uint32_t child : children_[p]) {
      const std::vector<std::uint32_t>& more = factor_.fronts_[child].rows;
      rows.insert(rows.end(), more.begin(), more.end());
    }
    rows.erase(std::remove_if(rows.begin(), rows.end(),
                              [&](std::uint32_t k) { return k < supernode.end; }),
               rows.end());
    std::sort(rows.begin(), rows.end());
    rows.erase(std::unique(rows.begin(), rows.end()), rows.end());

    std::uint32_t next = 0;
    for (std::uint32_t k = supernode.begin; k < supernode.end; ++k) local_[k] = next++;
    for (const std::uint32_t k : rows) local_[k] = next++;
    const auto width = 3 * static_cast<Eigen::Index>(supernode.end - supernode.begin);
    const auto below = 3 * static_cast<Eigen::Index>(rows.size());
    front.block.setZero(width + below, width);
    updates_[p].setZero(below, below);
  }

  void add_matrix(std::uint32_t p) {
    const Dissection::Supernode& supernode = supernodes_[p];
    Front& front = factor_.fronts_[p];
    for (std::uint32_t k = supernode.begin; k < supernode.end; ++k)
      for (Eigen::Index d = 0; d < 3; ++d)
        for (Eigen::SparseMatrix<double>::InnerIterator e(
                 matrix_, 3 * static_cast<Eigen::Index>(factor_.order_[k]) + d);
             e; ++e) {
          const std::uint32_t row = place_[static_cast<std::size_t>(e.row() / 3)];
          if (row < supernode.begin) continue;  // belongs to the front of that supernode
          front.block(3 * static_cast<Eigen::Index>(local_[row]) + e.row() % 3,
                      3 * static_cast<Eigen::Index>(k - supernode.begin) + d) += e.value();
        }
  }

  /// Both fronts number their rows in the order of elimination, so lower triangles stay lower
  /// triangles.
  void add_update(std::uint32_t p, std::uint32_t child) {
    Front& front = factor_.fronts_[p];
    const std::vector<std::uint32_t>& rows = factor_.fronts_[child].rows;
    const Eigen::Index width = front.width();
    const Eigen::MatrixXd update = std::exchange(updates_[child], {});
    assert(update.rows() == 3 * static_cast<Eigen::Index>(rows.size()));
    for (std::size_t j = 0; j < rows.size(); ++j) {
      const auto from = 3 * static_cast<Eigen::Index>(j);
      const auto to = 3 * static_cast<Eigen::Index>(local_[rows[j]]);
      for (std::size_t i = j; i < rows.size(); ++i) {
        const auto source = update.block<3, 3>(3 * static_cast<Eigen::Index>(i), from);
        const auto row = 3 * static_cast<Eigen::Index>(local_[rows[i]]);
        if (to < width)
          front.block.block<3, 3>(row, to) += source;
        else
          updates_[p].block<3, 3>(row - width, to - width) += source;
      }
    }
  }

  bool eliminate(std::uint32_t p) {
    Front& front = factor_.fronts_[p];
    const auto own = front.block.topRows(front.width());
    const auto lower = front.block.bottomRows(front.below());
    if (!factorise_lower(own)) return false;
    solve_right_transposed(own, lower);
    subtract_square(lower, updates_[p]);
    return true;
  }

  SparseCholesky& factor_;
  const Eigen::SparseMatrix<double>& matrix_;
  NodeGraph graph_;
  std::vector<Dissection::Supernode> supernodes_;
  std::vector<std::vector<std::uint32_t>> children_;
  std::vector<Eigen::MatrixXd> updates_;
  std::vector<std::uint32_t> place_;  // node -> place in the order
  std::vector<std::uint32_t> local_;  // place in the order -> row of blocks of the current front
};

SparseCholesky::SparseCholesky(const Eigen::SparseMatrix<double>& matrix,
                               const std::vector<Vec3>& points, Progress* progress) {
  positive_ = Builder(*this, matrix, points).run(progress);
}

Eigen::MatrixXd SparseCholesky::solve(const Eigen::MatrixXd& b) const {
  // Transposed, so that the entries of a node are contiguous.
  Eigen::MatrixXd x(b.cols(), b.rows());
  const auto nodes = static_cast<Eigen::Index>(order_.size());
  for (Eigen::Index k = 0; k < nodes; ++k)
    x.middleCols<3>(3 * k) =
        b.middleRows<3>(3 * static_cast<Eigen::Index>(order_[static_cast<std::size_t>(k)]))
            .transpose();

  Eigen::MatrixXd above;
  for (const Front& front : fronts_) {
    const auto own = x.middleCols(front.first, front.width());
    solve_right_transposed(front.block.topRows(front.width()), own);
    above.resize(b.cols(), front.below());
    multiply_transposed(own, front.block.bottomRows(front.below()), above);
    for (std::size_t r = 0; r < front.rows.size(); ++r)
      x.middleCols<3>(3 * static_cast<Eigen::Index>(front.rows[r])) -=
          above.middleCols<3>(3 * static_cast<Eigen::Index>(r));
  }
  for (auto front = fronts_.rbegin(); front != fronts_.rend(); ++front) {
    above.resize(b.cols(), front->below());
    for (std::size_t r = 0; r < front->rows.size(); ++r)
      above.middleCols<3>(3 * static_cast<Eigen::Index>(r)) =
          x.middleCols<3>(3 * static_cast<Eigen::Index>(front->rows[r]));
    const auto own = x.middleCols(front->first, front->width());
    subtract_product(above, front->block.bottomRows(front->below()), own);
    solve_right(front->block.topRows(front->width()), own);
  }

  Eigen::MatrixXd result(b.rows(), b.cols());
  for (Eigen::Index k = 0; k < nodes; ++k)
    result.middleRows<3>(3 * static_cast<Eigen::Index>(order_[static_cast<std::size_t>(k)])) =
        x.middleCols<3>(3 * k).transpose();
  return result;
}

}  // namespace springlod::elastic
