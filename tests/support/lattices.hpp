#pragma once

#include <array>
#include <cstdint>
#include <utility>
#include <vector>

#include "model/mass_spring.hpp"

namespace springlod::test {

using Pair = std::pair<std::uint32_t, std::uint32_t>;

/// Unit masses and volumes at `points`, springs of stiffness k between the sorted `pairs`.
inline MassSpringModel make_model(const std::vector<Vec3>& points, const std::vector<Pair>& pairs,
                                  double k = 1, double damping_time = 0) {
  MassSpringModel m;
  const std::size_t n = points.size();
  m.rest = points;
  m.mass.assign(n, 1);
  m.volume.assign(n, 1);
  m.contact_area.assign(n, 0);
  m.border.assign(n, 0);
  m.material.assign(n, 0);
  m.materials = {Material{.name = "stuff"}};
  for (const auto& [a, b] : pairs) {
    m.a.push_back(a);
    m.b.push_back(b);
    m.rest_length.push_back((points[b] - points[a]).norm());
    m.stiffness.push_back(k);
    m.damping.push_back(k * damping_time);
  }
  return m;
}

/// n unit masses along x, 1 m apart, each connected to the next.
inline MassSpringModel chain_of_nodes(std::uint32_t n, double k = 1) {
  std::vector<Vec3> points;
  std::vector<Pair> pairs;
  for (std::uint32_t i = 0; i < n; ++i) {
    points.emplace_back(i, 0, 0);
    if (i > 0) pairs.emplace_back(i - 1, i);
  }
  return make_model(points, pairs, k);
}

/// nx x ny x nz nodes at distance `a`, each connected to its 6 nearest and 12 second nearest
/// neighbours.
inline MassSpringModel box_lattice(int nx, int ny, int nz, double a = 1, double k = 1) {
  std::vector<Vec3> points;
  std::vector<Pair> pairs;
  const auto index = [&](int x, int y, int z) {
    return static_cast<std::uint32_t>((z * ny + y) * nx + x);
  };
  // The 9 of the 18 neighbours with higher numbers, in ascending order.
  constexpr std::array<std::array<int, 3>, 9> kForward{{{1, 0, 0},
                                                        {-1, 1, 0},
                                                        {0, 1, 0},
                                                        {1, 1, 0},
                                                        {0, -1, 1},
                                                        {-1, 0, 1},
                                                        {0, 0, 1},
                                                        {1, 0, 1},
                                                        {0, 1, 1}}};
  for (int z = 0; z < nz; ++z)
    for (int y = 0; y < ny; ++y)
      for (int x = 0; x < nx; ++x) {
        points.emplace_back(a * x, a * y, a * z);
        for (const auto& [dx, dy, dz] : kForward) {
          const int u = x + dx, v = y + dy, w = z + dz;
          if (u < 0 || v < 0 || u >= nx || v >= ny || w >= nz) continue;
          pairs.emplace_back(index(x, y, z), index(u, v, w));
        }
      }
  return make_model(points, pairs, k);
}

}  // namespace springlod::test
