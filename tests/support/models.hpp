#pragma once

// Models that the tests of several folders need.

#include <algorithm>
#include <cstdint>
#include <functional>
#include <random>
#include <utility>
#include <vector>

#include "model/mass_spring.hpp"

namespace springlod::test {

struct TableSpring {
  std::uint32_t a, b;
  double stiffness;
};

/// A model from positions, masses and springs at rest; volume = mass / 1000, c = 0.002 k.
inline MassSpringModel table_model(const std::vector<Vec3>& rest, const std::vector<double>& mass,
                                   std::vector<TableSpring> springs) {
  MassSpringModel m;
  m.rest = rest;
  m.mass = mass;
  for (const double each : mass) m.volume.push_back(each / 1000);
  m.contact_area.assign(rest.size(), 0);
  m.border.assign(rest.size(), 0);
  m.material.assign(rest.size(), 0);
  m.materials = {Material{.name = "test"}};
  for (TableSpring& s : springs)
    if (s.a > s.b) std::swap(s.a, s.b);
  std::sort(springs.begin(), springs.end(), [](const TableSpring& x, const TableSpring& y) {
    return std::pair(x.a, x.b) < std::pair(y.a, y.b);
  });
  for (const TableSpring& s : springs) {
    m.a.push_back(s.a);
    m.b.push_back(s.b);
    m.rest_length.push_back((rest[s.b] - rest[s.a]).norm());
    m.stiffness.push_back(s.stiffness);
    m.damping.push_back(0.002 * s.stiffness);
  }
  validate(m);
  return m;
}

/// Uniform number in [0, 1) with the same bits on every standard library.
inline double uniform(std::mt19937_64& random) {
  return static_cast<double>(random() >> 11) * 0x1p-53;
}

/// A jittered n^3 lattice with 18 neighbours and random masses, stiffnesses and materials.
inline MassSpringModel random_model(std::uint64_t seed, int n = 5) {
  std::mt19937_64 random(seed);
  std::vector<Vec3> rest;
  std::vector<double> mass;
  for (int z = 0; z < n; ++z)
    for (int y = 0; y < n; ++y)
      for (int x = 0; x < n; ++x) {
        const Vec3 jitter(uniform(random), uniform(random), uniform(random));
        rest.emplace_back(Vec3(x, y, z) + 0.3 * jitter);
        mass.push_back(0.5 + uniform(random));
      }
  std::vector<TableSpring> springs;
  const auto number = [n](int x, int y, int z) {
    return static_cast<std::uint32_t>((z * n + y) * n + x);
  };
  for (int z = 0; z < n; ++z)
    for (int y = 0; y < n; ++y)
      for (int x = 0; x < n; ++x)
        for (int dz = 0; dz <= 1; ++dz)
          for (int dy = -1; dy <= 1; ++dy)
            for (int dx = -1; dx <= 1; ++dx) {
              const bool forward = dz > 0 || dy > 0 || (dy == 0 && dx > 0);
              const int squared = dx * dx + dy * dy + dz * dz;
              const bool inside =
                  x + dx >= 0 && x + dx < n && y + dy >= 0 && y + dy < n && z + dz < n;
              if (!forward || squared == 0 || squared > 2 || !inside) continue;
              springs.push_back(
                  {number(x, y, z), number(x + dx, y + dy, z + dz), 50 + 100 * uniform(random)});
            }
  MassSpringModel m = table_model(rest, mass, springs);
  m.materials.push_back(Material{.name = "other"});
  for (int z = 0; z < n; ++z)
    for (int y = 0; y < n; ++y)
      for (int x = 0; x < n; ++x) {
        const std::uint32_t i = number(x, y, z);
        const bool outer = std::min({x, y, z}) == 0 || std::max({x, y, z}) == n - 1;
        m.border[i] = outer ? 1 : 0;
        m.contact_area[i] = outer ? uniform(random) : 0;
        m.material[i] = uniform(random) < 0.5 ? 0 : 1;
        m.volume[i] = 1e-3 * (0.5 + uniform(random));
      }
  validate(m);
  return m;
}

}  // namespace springlod::test
