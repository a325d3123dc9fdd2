#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <utility>
#include <vector>

#include <Eigen/Eigenvalues>

#include "elastic/stiffness.hpp"
#include "tests/support/lattices.hpp"

namespace springlod::test {

/// A box of nx x ny x nz cells of edge a in the `corners` style (each cell contributes an eighth of
/// its mass to its corners, k/4 to its edges, k/2 to its face diagonals): exactly E and nu = 1/4.
inline MassSpringModel corners_box(int nx, int ny, int nz, double a, double young, double density) {
  const auto node = [&](int x, int y, int z) {
    return static_cast<std::uint32_t>((z * (ny + 1) + y) * (nx + 1) + x);
  };
  std::vector<Vec3> points;
  for (int z = 0; z <= nz; ++z)
    for (int y = 0; y <= ny; ++y)
      for (int x = 0; x <= nx; ++x) points.emplace_back(a * Vec3(x, y, z));
  std::vector<double> cells(points.size(), 0);
  std::map<Pair, double> springs;
  const double k = young * a / 2.5;
  for (int z = 0; z < nz; ++z)
    for (int y = 0; y < ny; ++y)
      for (int x = 0; x < nx; ++x)
        for (int p = 0; p < 8; ++p) {
          const std::uint32_t i = node(x + (p & 1), y + (p >> 1 & 1), z + (p >> 2));
          ++cells[i];
          for (int q = p + 1; q < 8; ++q) {
            const std::uint32_t j = node(x + (q & 1), y + (q >> 1 & 1), z + (q >> 2));
            const int apart = (p ^ q) == 7 ? 3 : ((p ^ q) & ((p ^ q) - 1)) == 0 ? 1 : 2;
            if (apart < 3) springs[std::minmax(i, j)] += apart == 1 ? k / 4 : k / 2;
          }
        }
  std::vector<Pair> pairs;
  for (const auto& [pair, stiffness] : springs) pairs.push_back(pair);
  MassSpringModel m = make_model(points, pairs);
  std::uint32_t s = 0;
  for (const auto& [pair, stiffness] : springs) m.stiffness[s++] = stiffness;
  for (std::uint32_t i = 0; i < m.node_count(); ++i) {
    m.volume[i] = cells[i] * a * a * a / 8;
    m.mass[i] = density * m.volume[i];
  }
  return m;
}

/// Both models combined into one disconnected model.
inline MassSpringModel side_by_side(const MassSpringModel& first, const MassSpringModel& second,
                                    const Vec3& shift) {
  MassSpringModel both = first;
  const auto append = [](auto& to, const auto& from) {
    to.insert(to.end(), from.begin(), from.end());
  };
  for (const Vec3& p : second.rest) both.rest.emplace_back(p + shift);
  append(both.mass, second.mass);
  append(both.volume, second.volume);
  append(both.contact_area, second.contact_area);
  append(both.border, second.border);
  append(both.material, second.material);
  for (std::uint32_t s = 0; s < second.spring_count(); ++s) {
    both.a.push_back(second.a[s] + first.node_count());
    both.b.push_back(second.b[s] + first.node_count());
  }
  append(both.rest_length, second.rest_length);
  append(both.stiffness, second.stiffness);
  append(both.damping, second.damping);
  return both;
}

/// Eigenvalues of M^-1/2 K M^-1/2 by a dense solver.
inline Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> dense_spectrum(const MassSpringModel& m) {
  Eigen::VectorXd weight(3 * static_cast<Eigen::Index>(m.node_count()));
  for (Eigen::Index i = 0; i < weight.size(); ++i)
    weight[i] = 1 / std::sqrt(m.mass[static_cast<std::size_t>(i / 3)]);
  const Eigen::MatrixXd k = elastic::stiffness_matrix(m);
  return Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(weight.asDiagonal() * k *
                                                        weight.asDiagonal());
}

inline Eigen::VectorXd flatten(const std::vector<Vec3>& vectors) {
  Eigen::VectorXd flat(3 * static_cast<Eigen::Index>(vectors.size()));
  for (std::size_t i = 0; i < vectors.size(); ++i)
    flat.segment<3>(3 * static_cast<Eigen::Index>(i)) = vectors[i];
  return flat;
}

}  // namespace springlod::test
