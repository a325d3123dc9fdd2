#include "elastic/stiffness.hpp"

#include <cstddef>
#include <vector>

#include <fmt/format.h>

#include "base/error.hpp"
#include "model/spring_rows.hpp"

namespace springlod::elastic {

namespace {

struct Block {
  std::uint32_t row;
  Mat3 value;
};

/// The 3 x 3 blocks in the columns of node j, by ascending row.
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
  for (std::uint32_t j = 0; j < model.node_count(); ++j) {
    fill_column(model, rows, j, column);
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
}

}  // namespace springlod::elastic
