#pragma once

#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "model/mesh.hpp"

namespace springlod::test {

inline void add_part(TriangleMesh& mesh, std::string name, const std::vector<Vec3>& positions,
                     const std::vector<Triangle>& triangles, std::string material = "") {
  const auto base = static_cast<std::uint32_t>(mesh.positions.size());
  mesh.parts.push_back({std::move(name), std::move(material),
                        static_cast<std::uint32_t>(mesh.triangles.size()),
                        static_cast<std::uint32_t>(triangles.size())});
  mesh.positions.insert(mesh.positions.end(), positions.begin(), positions.end());
  for (const Triangle& t : triangles)
    mesh.triangles.push_back({base + t[0], base + t[1], base + t[2]});
}

inline std::vector<Vec3> box_corners(const Vec3& low, const Vec3& high) {
  std::vector<Vec3> corners;
  for (unsigned c = 0; c < 8; ++c)
    corners.emplace_back((c & 1U) != 0 ? high.x() : low.x(), (c & 2U) != 0 ? high.y() : low.y(),
                         (c & 4U) != 0 ? high.z() : low.z());
  return corners;
}

/// The 12 triangles of a box: bottom, top, front (-y), back, left (-x), right, two each.
inline std::vector<Triangle> box_triangles() {
  return {{0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}, {0, 1, 5}, {0, 5, 4},
          {2, 6, 7}, {2, 7, 3}, {0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}};
}

inline void add_box(TriangleMesh& mesh, std::string name, const Vec3& low, const Vec3& high,
                    std::string material = "") {
  add_part(mesh, std::move(name), box_corners(low, high), box_triangles(), std::move(material));
}

/// A sphere of latitudes and longitudes; closed, outward.
inline void add_sphere(TriangleMesh& mesh, std::string name, const Vec3& center, double radius,
                       std::uint32_t rings = 48, std::string material = "") {
  const std::uint32_t sectors = 2 * rings;
  std::vector<Vec3> positions{center - radius * Vec3::UnitZ(), center + radius * Vec3::UnitZ()};
  std::vector<Triangle> triangles;
  const auto at = [&](std::uint32_t ring, std::uint32_t sector) {
    return 2 + (ring - 1) * sectors + sector % sectors;
  };
  for (std::uint32_t r = 1; r < rings; ++r)
    for (std::uint32_t s = 0; s < sectors; ++s) {
      const double theta = std::numbers::pi * r / rings;
      const double phi = 2 * std::numbers::pi * s / sectors;
      positions.emplace_back(center + radius * Vec3(std::sin(theta) * std::cos(phi),
                                                    std::sin(theta) * std::sin(phi),
                                                    -std::cos(theta)));
    }
  for (std::uint32_t s = 0; s < sectors; ++s) {
    triangles.push_back({0, at(1, s + 1), at(1, s)});
    triangles.push_back({1, at(rings - 1, s), at(rings - 1, s + 1)});
    for (std::uint32_t r = 1; r + 1 < rings; ++r) {
      triangles.push_back({at(r, s), at(r, s + 1), at(r + 1, s + 1)});
      triangles.push_back({at(r, s), at(r + 1, s + 1), at(r + 1, s)});
    }
  }
  add_part(mesh, std::move(name), positions, triangles, std::move(material));
}

inline void turn_inside_out(TriangleMesh& mesh, const MeshPart& part) {
  for (std::uint32_t i = 0; i < part.triangle_count; ++i)
    std::swap(mesh.triangles[part.first_triangle + i][1],
              mesh.triangles[part.first_triangle + i][2]);
}

}  // namespace springlod::test
