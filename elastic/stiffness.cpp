#include "elastic/stiffness.hpp"

#include <algorithm>
#include <cstddef>
#include <optional>
#include <vector>

#include <fmt/format.h>

#include "base/error.hpp"
#include "model/spring_rows.hpp"
#include "model/terms_of_nodes.hpp"

namespace springlod::elastic {

namespace {

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

  /// Adds the blocks T b_i b_j^T of the terms of node j to its column.
  void add_to(std::uint32_t j, std::vector<Block>& column) {
    rows_.clear();
    for (const Block& block : column) block_at(block.row) += block.value;
    for (const auto& [term, own] : of_nodes_.of(j)) {
      const Vec3 pressure = terms_.modulus[term] * terms_.gradient[own];
      for (std::uint32_t e = terms_.start[term]; e < terms_.start[term + 1]; ++e)
        block_at(terms_.node[e]) += terms_.gradient[e] * pressure.transpose();
    }
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
void fill_column(const MassSpringModel& model, const SpringRows& rows, std::uint32_t j,
                 std::vector<Block>& column) {
  column.clear();
  std::size_t own = 0;
  Mat3 sum = Mat3::Zero();
  rows.for_each(j, [&](std::uint32_t i, std::uint32_t s) {
    const Vec3 u = spring_direction(model, s);
    const Mat3 block = model.stiffness[s] * u * u.transpose();
    sum += block;
    if (i < j) ++own;
    column.push_back({i, -block});
  });
  column.insert(column.begin() + static_cast<std::ptrdiff_t>(own), {j, sum});
}

}  // namespace

Eigen::SparseMatrix<double> stiffness_matrix(const MassSpringModel& model) {
  const SpringRows rows(model);
  const auto size = 3 * static_cast<Eigen::Index>(model.node_count());
  Eigen::SparseMatrix<double> matrix(size, size);
  matrix.reserve(9 * (static_cast<Eigen::Index>(model.node_count()) +
                      2 * static_cast<Eigen::Index>(model.spring_count())));
  std::vector<Block> column;
  std::optional<TermColumns> terms;
  if (!model.dilatation.empty()) terms.emplace(model);
  for (std::uint32_t j = 0; j < model.node_count(); ++j) {
    fill_column(model, rows, j, column);
    if (terms) terms->add_to(j, column);
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

void apply_stiffness(const MassSpringModel& model, const std::vector<Vec3>& u,
                     std::vector<Vec3>& f) {
  if (u.size() != model.rest.size())
    throw InputError(
        fmt::format("stiffness: {} displacements for {} nodes", u.size(), model.rest.size()));
  f.assign(model.rest.size(), Vec3::Zero());
  for (std::uint32_t s = 0; s < model.spring_count(); ++s) {
    const Vec3 direction = spring_direction(model, s);
    const Vec3 tension =
        model.stiffness[s] * direction.dot(u[model.b[s]] - u[model.a[s]]) * direction;
    f[model.a[s]] -= tension;
    f[model.b[s]] += tension;
  }
  const DilatationTerms& terms = model.dilatation;
  for (std::uint32_t t = 0; t < terms.count(); ++t) {
    const double stress = terms.modulus[t] * linear_dilatation(terms, t, u);
    for (std::uint32_t e = terms.start[t]; e < terms.start[t + 1]; ++e)
      f[terms.node[e]] += stress * terms.gradient[e];
  }
}

}  // namespace springlod::elastic
