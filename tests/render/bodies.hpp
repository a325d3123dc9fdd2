#pragma once

// Bodies to draw, built here so that images do not depend on the builders of other folders.

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <string>
#include <vector>

#include "model/chain.hpp"
#include "model/mass_spring.hpp"
#include "model/mesh.hpp"
#include "tests/support/meshes.hpp"

namespace springlod::test {

/// Joins lattice points `cells` with their 6 + 12 nearest neighbours; lattice spacing `a` [m].
template <typename MaterialOf>
MassSpringModel lattice_model(const std::vector<std::array<int, 3>>& cells, double a,
                              std::vector<Material> materials, MaterialOf material_of) {
  MassSpringModel m;
  m.materials = std::move(materials);
  const auto near = [](const std::array<int, 3>& p, const std::array<int, 3>& q) {
    const int d = (p[0] - q[0]) * (p[0] - q[0]) + (p[1] - q[1]) * (p[1] - q[1]) +
                  (p[2] - q[2]) * (p[2] - q[2]);
    return d == 1 || d == 2;
  };
  for (const auto& c : cells) {
    const Vec3 p = a * Vec3(c[0], c[1], c[2]);
    m.rest.push_back(p);
    m.mass.push_back(1);
    m.volume.push_back(a * a * a);
    m.contact_area.push_back(0);
    m.material.push_back(material_of(p));
  }
  std::vector<int> ends(cells.size(), 0);
  for (std::uint32_t i = 0; i < cells.size(); ++i)
    for (std::uint32_t j = i + 1; j < cells.size(); ++j)
      if (near(cells[i], cells[j])) {
        m.a.push_back(i);
        m.b.push_back(j);
        m.rest_length.push_back((m.rest[i] - m.rest[j]).norm());
        m.stiffness.push_back(1);
        m.damping.push_back(0);
        ++ends[i];
        ++ends[j];
      }
  for (const int e : ends) m.border.push_back(e < 18 ? 1 : 0);
  return m;
}

/// A ball of 281 nodes with core and shell, like that of the paper: the lattice points nearest to a
/// point off the lattice. Radius about 0.4 m at a = 0.1 m.
inline MassSpringModel ball(double a = 0.1) {
  const Vec3 c(0.04, 0.02, 0.01);
  std::vector<std::array<int, 3>> cells;
  for (int z = -6; z <= 6; ++z)
    for (int y = -6; y <= 6; ++y)
      for (int x = -6; x <= 6; ++x) cells.push_back({x, y, z});
  const auto distance = [&](const std::array<int, 3>& p) {
    return (Vec3(p[0], p[1], p[2]) - c).norm();
  };
  std::stable_sort(cells.begin(), cells.end(),
                   [&](const auto& p, const auto& q) { return distance(p) < distance(q); });
  cells.resize(281);
  std::sort(cells.begin(), cells.end());
  Material core{.name = "core", .colour = {0.84F, 0.37F, 0.0F}};
  Material shell{.name = "shell", .colour = {0.34F, 0.62F, 0.85F}};
  return lattice_model(cells, a, {core, shell},
                       [&](const Vec3& p) { return (p - a * c).norm() < 2.3 * a ? 0U : 1U; });
}

/// Two thick rods with a thinner rubber joint; 0.92 m long along x.
inline TriangleMesh dumbbell_mesh(int segments = 48) {
  TriangleMesh mesh;
  append_cylinder(mesh, "rod_a", -0.46, -0.10, 0.10, segments, 12);
  append_cylinder(mesh, "rubber", -0.10, 0.10, 0.075, segments, 10);
  append_cylinder(mesh, "rod_b", 0.10, 0.46, 0.10, segments, 12);
  return mesh;
}

/// A bar of 4 x 4 x 23 nodes along x that represents the dumbbell.
inline MassSpringModel bar(double a = 0.04) {
  std::vector<std::array<int, 3>> cells;
  for (int x = 0; x < 23; ++x)
    for (int y = 0; y < 4; ++y)
      for (int z = 0; z < 4; ++z) cells.push_back({x, y, z});
  Material rod{.name = "rod", .colour = {0.25F, 0.45F, 0.68F}};
  Material rubber{.name = "rubber", .colour = {0.90F, 0.55F, 0.15F}};
  MassSpringModel m = lattice_model(cells, a, {rod, rubber}, [&](const Vec3& p) {
    return p.x() > 8.5 * a && p.x() < 13.5 * a ? 1U : 0U;
  });
  for (Vec3& p : m.rest) p -= a * Vec3(11, 1.5, 1.5);
  return m;
}

/// Bends a body along x into an arc of `curvature` [1/m] in the x-z plane, then lifts it.
inline std::vector<Vec3> bent(const std::vector<Vec3>& points, double curvature, const Vec3& move) {
  std::vector<Vec3> out;
  for (const Vec3& p : points) {
    const double angle = p.x() * curvature;
    const double r = 1 / curvature - p.z();
    out.emplace_back(Vec3(r * std::sin(angle), p.y(), 1 / curvature - r * std::cos(angle)) + move);
  }
  return out;
}

/// The positions translated by `move`.
inline std::vector<Vec3> moved(const std::vector<Vec3>& points, const Vec3& move) {
  std::vector<Vec3> out(points);
  for (Vec3& p : out) p += move;
  return out;
}

}  // namespace springlod::test
