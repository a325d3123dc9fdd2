#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include <Eigen/SparseCore>

#include "model/mass_spring.hpp"
#include "model/spring_rows.hpp"
#include "model/terms_of_nodes.hpp"

namespace springlod::elastic {

/// A 3 x 3 block of a column.
struct Block {
  std::uint32_t row;
  Mat3 value;
};

/// The dilatation terms in the columns of each node.
class TermColumns {
 public:
  explicit TermColumns(const MassSpringModel& model)
      : terms_(model.dilatation),
        of_nodes_(model),
        sum_(model.node_count()),
        in_sum_(model.node_count(), 0) {}

  /// Adds the blocks of the terms of node j to its column: of_term(term, row, column), where row
  /// and column are numbers of entries of the term.
  template <class OfTerm>
  void add_to(std::uint32_t j, std::vector<Block>& column, const OfTerm& of_term) {
    rows_.clear();
    for (const Block& block : column) block_at(block.row) += block.value;
    for (const auto& [term, own] : of_nodes_.of(j))
      for (std::uint32_t e = terms_.start[term]; e < terms_.start[term + 1]; ++e)
        block_at(terms_.node[e]) += of_term(term, e, own);
    std::sort(rows_.begin(), rows_.end());
    column.clear();
    for (const std::uint32_t row : rows_) {
      column.push_back({row, sum_[row]});
      in_sum_[row] = 0;
    }
  }

 private:
  Mat3& block_at(std::uint32_t row) {
    if (in_sum_[row] == 0) {
      in_sum_[row] = 1;
      sum_[row] = Mat3::Zero();
      rows_.push_back(row);
    }
    return sum_[row];
  }

  const DilatationTerms& terms_;
  TermsOfNodes of_nodes_;
  std::vector<Mat3> sum_;             // N: of the rows in rows_
  std::vector<std::uint8_t> in_sum_;  // N
  std::vector<std::uint32_t> rows_;
};

/// The 3 x 3 blocks of the springs in the columns of node j, by ascending row.
template <class OfSpring>
void fill_column(const SpringRows& rows, std::uint32_t j, std::vector<Block>& column,
                 const OfSpring& of_spring) {
  column.clear();
  std::size_t own = 0;
  Mat3 sum = Mat3::Zero();
  rows.for_each(j, [&](std::uint32_t i, std::uint32_t s) {
    const Mat3 block = of_spring(s);
    sum += block;
    if (i < j) ++own;
    column.push_back({i, -block});
  });
  column.insert(column.begin() + static_cast<std::ptrdiff_t>(own), {j, sum});
}

/// A symmetric 3N x 3N matrix of second derivatives of an energy of springs and dilatation terms;
/// node i has the rows 3i..3i+2, both triangles are stored. `of_spring(s)`: the block of spring s
/// at its own ends, of which those that couple them are the negative. `of_term`: see TermColumns.
template <class OfSpring, class OfTerm>
Eigen::SparseMatrix<double> assemble(const MassSpringModel& model, const OfSpring& of_spring,
                                     const OfTerm& of_term) {
  const SpringRows rows(model);
  const auto size = 3 * static_cast<Eigen::Index>(model.node_count());
  Eigen::SparseMatrix<double> matrix(size, size);
  matrix.reserve(9 * (static_cast<Eigen::Index>(model.node_count()) +
                      2 * static_cast<Eigen::Index>(model.spring_count())));
  std::vector<Block> column;
  std::optional<TermColumns> terms;
  if (!model.dilatation.empty()) terms.emplace(model);
  for (std::uint32_t j = 0; j < model.node_count(); ++j) {
    fill_column(rows, j, column, of_spring);
    if (terms) terms->add_to(j, column, of_term);
    for (Eigen::Index c = 0; c < 3; ++c) {
      const Eigen::Index number = 3 * static_cast<Eigen::Index>(j) + c;
      matrix.startVec(number);
      for (const Block& block : column)
        for (Eigen::Index r = 0; r < 3; ++r)
          matrix.insertBack(3 * static_cast<Eigen::Index>(block.row) + r, number) =
              block.value(r, c);
    }
  }
  matrix.finalize();
  return matrix;
}

/// The 3n x 3n block of a 3N x 3N matrix that belongs to `nodes` (n, ascending).
inline Eigen::SparseMatrix<double> block_of_nodes(const Eigen::SparseMatrix<double>& matrix,
                                                  const std::vector<std::uint32_t>& nodes) {
  std::vector<Eigen::Triplet<double>> entries;
  const auto size = 3 * static_cast<Eigen::Index>(nodes.size());
  Eigen::SparseMatrix<double> select(matrix.rows(), size);
  for (std::size_t i = 0; i < nodes.size(); ++i)
    for (int d = 0; d < 3; ++d)
      entries.emplace_back(static_cast<int>(3 * nodes[i]) + d, static_cast<int>(3 * i) + d, 1.0);
  select.setFromTriplets(entries.begin(), entries.end());
  return select.transpose() * matrix * select;
}

}  // namespace springlod::elastic
