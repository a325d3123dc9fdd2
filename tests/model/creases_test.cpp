#include "model/creases.hpp"

#include <utility>

#include <Eigen/Geometry>
#include <catch2/catch.hpp>

#include "tests/support/assets.hpp"
#include "tests/support/meshes.hpp"

using namespace springlod;
using namespace springlod::test;

TEST_CASE("A box has one drawn vertex for each side at each corner, with the normal of the side") {
  const TriangleMesh box = test::box_mesh({1, 2, 3});
  const SplitSurface surface = split_at_creases(box);
  CHECK(surface.source.size() == 24);
  const auto normals = vertex_normals(surface, box.positions);
  for (std::size_t t = 0; t < box.triangles.size(); ++t) {
    const auto& [a, b, c] = box.triangles[t];
    const Vec3 o = box.positions[a];
    const Vec3 normal = (box.positions[b] - o).cross(box.positions[c] - o).normalized();
    for (std::size_t corner = 0; corner < 3; ++corner) {
      const std::uint32_t v = surface.triangles[t][corner];
      CHECK(surface.source[v] == box.triangles[t][corner]);
      CHECK((normals[v].cast<double>() - normal).norm() < 1e-6);
    }
  }
}

TEST_CASE("Below the crease angle vertices are not split and normals are averaged") {
  TriangleMesh box = test::box_mesh({1, 1, 1});
  box.parts = {{"all", "", 0, 12}};  // vertices between parts are always split
  const SplitSurface surface = split_at_creases(box, 100);
  CHECK(surface.source.size() == 8);
  for (const auto& n : vertex_normals(surface, box.positions)) CHECK(n.cwiseAbs().minCoeff() > 0.3);
}

TEST_CASE("Triangles without area have zero normals and keep all vertices") {
  TriangleMesh mesh;
  mesh.positions = {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {9, 9, 9}};
  mesh.triangles = {{0, 1, 2}, {1, 1, 1}};
  mesh.parts = {{"sliver", "", 0, 2}};
  const SplitSurface surface = split_at_creases(mesh);
  for (const auto& n : vertex_normals(surface, mesh.positions)) CHECK(n.norm() == 0);
  for (const Triangle& t : surface.triangles)
    for (const std::uint32_t v : t) CHECK(v < surface.source.size());
}

TEST_CASE("A cylinder is split at its rims only and has the normals of a cylinder") {
  TriangleMesh mesh;
  append_cylinder(mesh, "rod", -1, 1, 0.5, 32, 4);
  const SplitSurface surface = split_at_creases(mesh);
  CHECK(surface.source.size() ==
        mesh.positions.size() + 2 * 32);  // the vertices of both rims are doubled
  CHECK(surface.closed);
  const auto normals = vertex_normals(surface, mesh.positions);
  int flat = 0;
  for (std::size_t i = 0; i < normals.size(); ++i) {
    const Vec3& p = mesh.positions[surface.source[i]];
    const Vec3 n = normals[i].cast<double>();
    const Vec3 outward(0, p.y(), p.z());
    if (std::abs(n.x()) > 0.5) {
      ++flat;
      CHECK(std::abs(n.x()) == Approx(1).margin(1e-5));
    } else {
      CHECK(n.dot(outward.normalized()) == Approx(1).margin(1e-2));
    }
  }
  CHECK(flat == 2 * 33);
}

TEST_CASE("A mesh with a hole or an inverted part is drawn from both sides") {
  TriangleMesh open = sphere_mesh(1, 12, 6);
  open.triangles.pop_back();
  open.parts[0].triangle_count -= 1;
  CHECK_FALSE(split_at_creases(open).closed);
  TriangleMesh turned = sphere_mesh(1, 12, 6);
  for (Triangle& t : turned.triangles) std::swap(t[1], t[2]);
  CHECK_FALSE(split_at_creases(turned).closed);
  CHECK(split_at_creases(sphere_mesh(1, 12, 6)).closed);
}

TEST_CASE("Normals rotate with the body") {
  const TriangleMesh mesh = sphere_mesh(1, 32, 16);
  const SplitSurface surface = split_at_creases(mesh);
  CHECK(surface.source.size() == mesh.positions.size());  // no crease anywhere
  const Mat3 turn = Eigen::AngleAxisd(1.1, Vec3(1, 2, 3).normalized()).toRotationMatrix();
  std::vector<Vec3> turned;
  for (const Vec3& p : mesh.positions) turned.emplace_back(turn * p);
  const auto before = vertex_normals(surface, mesh.positions);
  const auto after = vertex_normals(surface, turned);
  for (std::size_t i = 0; i < before.size(); ++i)
    CHECK((turn.cast<float>() * before[i] - after[i]).norm() < 1e-5F);
}
