#include "model/creases.hpp"

#include <cmath>

#include <catch2/catch.hpp>

#include "tests/model/sample_assets.hpp"

namespace springlod {
namespace {

TEST_CASE("A box has a vertex a side at each corner, with the normal of the side") {
  const TriangleMesh box = test::box_mesh({1, 2, 3});
  const ShadedMesh shaded = split_at_creases(box);
  CHECK(shaded.vertex.size() == 24);
  for (std::size_t t = 0; t < box.triangles.size(); ++t) {
    const Triangle& tri = box.triangles[t];
    const Vec3 normal = (box.positions[tri[1]] - box.positions[tri[0]])
                            .cross(box.positions[tri[2]] - box.positions[tri[0]])
                            .normalized();
    for (std::size_t corner = 0; corner < 3; ++corner) {
      const std::uint32_t v = shaded.triangles[t][corner];
      CHECK(shaded.vertex[v] == tri[corner]);
      CHECK((shaded.normals[v] - normal).norm() < 1e-12);
    }
  }
}

TEST_CASE("Below the crease angle vertices stay whole and normals are means") {
  const ShadedMesh shaded = split_at_creases(test::box_mesh({1, 1, 1}), 100);
  CHECK(shaded.vertex.size() == 8);
  for (const Vec3& n : shaded.normals) CHECK(n.cwiseAbs().minCoeff() > 0.3);
}

TEST_CASE("Triangles without area get a normal of unit length too") {
  TriangleMesh mesh;
  mesh.positions = {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {9, 9, 9}};
  mesh.triangles = {{0, 1, 2}, {1, 1, 1}};
  mesh.parts = {{"sliver", "", 0, 2}};
  const ShadedMesh shaded = split_at_creases(mesh);
  REQUIRE(shaded.normals.size() == shaded.vertex.size());
  for (const Vec3& n : shaded.normals) CHECK(n.norm() == Approx(1));
  for (const Triangle& t : shaded.triangles)
    for (const std::uint32_t v : t) CHECK(v < shaded.vertex.size());
}

}  // namespace
}  // namespace springlod
