#include "model/stiffness.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "model/error.hpp"

namespace springlod {

Eigen::SparseMatrix<double> stiffness_matrix(const MassSpringModel& model) {
  std::vector<Eigen::Triplet<double>> entries;
  entries.reserve(std::size_t{36} * model.spring_count());
  const auto add_block = [&](std::uint32_t i, std::uint32_t j, const Mat3& block) {
    for (int r = 0; r < 3; ++r)
      for (int c = 0; c < 3; ++c)
        entries.emplace_back(static_cast<int>(3 * i) + r, static_cast<int>(3 * j) + c, block(r, c));
  };
  for (std::uint32_t s = 0; s < model.spring_count(); ++s) {
    const Vec3 u = spring_direction(model, s);
    const Mat3 block = model.stiffness[s] * u * u.transpose();
    add_block(model.a[s], model.a[s], block);
    add_block(model.b[s], model.b[s], block);
    add_block(model.a[s], model.b[s], -block);
    add_block(model.b[s], model.a[s], -block);
  }
  const auto size = 3 * static_cast<Eigen::Index>(model.node_count());
  Eigen::SparseMatrix<double> matrix(size, size);
  matrix.setFromTriplets(entries.begin(), entries.end());
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

}  // namespace springlod
