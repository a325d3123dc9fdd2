#pragma once

// Closed surfaces that the tests of several folders need.

#include <cmath>
#include <cstdint>
#include <numbers>
#include <string>

#include "model/mesh.hpp"

namespace springlod::test {

inline constexpr double kPi = std::numbers::pi;

/// Closed sphere by latitude and longitude, optionally bumpy; about 2 rings (segments - 1)
/// triangles. Organic at `bumps` = 0.15.
inline TriangleMesh sphere_mesh(double radius, int segments, int rings, double bumps = 0) {
  TriangleMesh mesh;
  const auto point = [&](double theta, double phi) {
    const Vec3 n(std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi), std::cos(theta));
    const double r = 1 + bumps * (std::sin(3 * n.x() + 1) * std::cos(4 * n.y()) +
                                  0.5 * std::sin(5 * n.z() + 2 * n.x()));
    return Vec3(radius * r * n);
  };
  mesh.positions.push_back(point(0, 0));
  for (int i = 1; i < rings; ++i)
    for (int j = 0; j < segments; ++j)
      mesh.positions.push_back(point(kPi * i / rings, 2 * kPi * j / segments));
  mesh.positions.push_back(point(kPi, 0));
  const auto at = [&](int i, int j) {
    return static_cast<std::uint32_t>(1 + (i - 1) * segments + j % segments);
  };
  const auto last = static_cast<std::uint32_t>(mesh.positions.size() - 1);
  for (int j = 0; j < segments; ++j) {
    mesh.triangles.push_back({0, at(1, j), at(1, j + 1)});
    for (int i = 1; i + 1 < rings; ++i) {
      mesh.triangles.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1)});
      mesh.triangles.push_back({at(i, j), at(i + 1, j + 1), at(i, j + 1)});
    }
    mesh.triangles.push_back({at(rings - 1, j), last, at(rings - 1, j + 1)});
  }
  mesh.parts = {{"body", "", 0, static_cast<std::uint32_t>(mesh.triangles.size())}};
  return mesh;
}

/// A closed cylinder along x from x0 to x1 with flat ends, appended as a part.
inline void append_cylinder(TriangleMesh& mesh, const std::string& name, double x0, double x1,
                            double radius, int segments, int slices) {
  const auto first_vertex = static_cast<std::uint32_t>(mesh.positions.size());
  const auto first_triangle = static_cast<std::uint32_t>(mesh.triangles.size());
  for (int i = 0; i <= slices; ++i)
    for (int j = 0; j < segments; ++j) {
      const double phi = 2 * kPi * j / segments;
      mesh.positions.emplace_back(x0 + (x1 - x0) * i / slices, radius * std::cos(phi),
                                  radius * std::sin(phi));
    }
  const auto low = static_cast<std::uint32_t>(mesh.positions.size());
  mesh.positions.emplace_back(x0, 0, 0);
  mesh.positions.emplace_back(x1, 0, 0);
  const auto at = [&](int i, int j) {
    return first_vertex + static_cast<std::uint32_t>(i * segments + j % segments);
  };
  for (int j = 0; j < segments; ++j) {
    for (int i = 0; i < slices; ++i) {
      mesh.triangles.push_back({at(i, j), at(i + 1, j + 1), at(i + 1, j)});
      mesh.triangles.push_back({at(i, j), at(i, j + 1), at(i + 1, j + 1)});
    }
    mesh.triangles.push_back({low, at(0, j + 1), at(0, j)});
    mesh.triangles.push_back({low + 1, at(slices, j), at(slices, j + 1)});
  }
  mesh.parts.push_back({name, "", first_triangle,
                        static_cast<std::uint32_t>(mesh.triangles.size()) - first_triangle});
}

}  // namespace springlod::test
