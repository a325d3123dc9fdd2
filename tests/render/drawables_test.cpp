#include "render/drawables.hpp"

#include <catch2/catch.hpp>

#include "model/creases.hpp"
#include "model/drawn_colour.hpp"
#include "render/cut.hpp"
#include "render/plane.hpp"
#include "render/strain_colour.hpp"
#include "tests/render/bodies.hpp"

using namespace springlod;
using namespace springlod::render;
using namespace springlod::test;

TEST_CASE("the strain scale goes from blue through grey to red") {
  const Colour blue = strain_colour(-1);
  const Colour grey = strain_colour(0);
  const Colour red = strain_colour(1);
  CHECK(blue.b > blue.r + 0.3F);
  CHECK(grey.r == Approx(grey.b));
  CHECK(red.r > red.b + 0.3F);
  CHECK(strain_colour(-9) == blue);
  CHECK(strain_colour(9) == red);
}

TEST_CASE("a stretched spring is red, a compressed one blue, one at rest grey") {
  MassSpringModel model = bar();
  std::vector<Vec3> x = model.rest;
  for (Vec3& p : x) p.x() *= 1.05;
  DrawnBody body;
  body.model = &model;
  body.node_positions = &x;
  body.style.springs = true;
  body.style.spring_colour = SpringColour::strain;
  body.style.strain_range = 0.05;
  const auto springs = spring_instances(body, Vec3::Zero());
  for (std::size_t s = 0; s < springs.size(); ++s) {
    const Vec3 along = model.rest[model.b[s]] - model.rest[model.a[s]];
    const Colour& colour = springs[s].colour_a;
    if (along.x() == 0)
      CHECK(colour.r == Approx(colour.b).margin(1e-5));
    else
      CHECK(colour.r > colour.b + 0.1F);
  }
  for (Vec3& p : x) p.x() *= 0.9;
  CHECK(spring_instances(body, Vec3::Zero()).back().colour_a.b >
        strain_colour(0).b - 0.5F);  // still distinguishable from grey
  const auto squeezed = spring_instances(body, Vec3::Zero());
  for (std::size_t s = 0; s < squeezed.size(); ++s)
    if (model.rest[model.b[s]].x() != model.rest[model.a[s]].x())
      CHECK(squeezed[s].colour_a.b > squeezed[s].colour_a.r);
}

TEST_CASE("springs blend the materials of their ends") {
  const MassSpringModel model = bar();
  DrawnBody body;
  body.model = &model;
  body.style.springs = true;
  const auto springs = spring_instances(body, Vec3::Zero());
  for (std::size_t s = 0; s < springs.size(); ++s) {
    CHECK(springs[s].colour_a == model.materials[model.material[model.a[s]]].colour);
    CHECK(springs[s].colour_b == model.materials[model.material[model.b[s]]].colour);
  }
}

TEST_CASE("materials with the default grey are drawn in different colours") {
  MassSpringModel model = bar();
  for (Material& m : model.materials) m.colour = Colour{};
  CHECK_FALSE(drawn_colour(model.materials, 0) == drawn_colour(model.materials, 1));
  model.materials[1].colour = {0.1F, 0.2F, 0.3F};
  CHECK(drawn_colour(model.materials, 1) == Colour{0.1F, 0.2F, 0.3F});
}

TEST_CASE("bold inner nodes are larger and red, border nodes smaller") {
  const MassSpringModel model = ball();
  DrawnBody body;
  body.model = &model;
  body.style.node_radius = 0.01;
  body.style.bold_inner_nodes = true;
  const auto nodes = node_instances(body, Vec3::Zero());
  int inner = 0;
  for (std::uint32_t i = 0; i < nodes.size(); ++i) {
    if (model.border[i] != 0) {
      CHECK(nodes[i].radius < 0.01F);
    } else {
      ++inner;
      CHECK(nodes[i].radius > 0.01F);
      CHECK(nodes[i].colour.r > nodes[i].colour.g + 0.4F);
    }
  }
  CHECK(inner > 50);
}

TEST_CASE("a box as drawn is closed and has its volume") {
  DrawnBox box;
  box.half_size = Vec3(1, 2, 3);
  box.rotation = Eigen::AngleAxisd(0.7, Vec3::UnitZ()).toRotationMatrix();
  const TriangleMesh mesh = box_mesh(box);
  CHECK(signed_volume(mesh, mesh.parts[0]) == Approx(48));
  const SplitSurface surface = split_at_creases(mesh);
  CHECK(surface.closed);
  CHECK(surface.source.size() == 24);
}

TEST_CASE("the grid of the floor has a spacing of 1 m in views of a few metres") {
  CHECK(grid_spacing(3) == Approx(1));
  CHECK(grid_spacing(0.3) == Approx(0.1));
  CHECK(grid_spacing(40) == Approx(10));
}

TEST_CASE("a plane patch lies in its plane, around the foot of the camera's target") {
  Camera camera;
  camera.target = Vec3(10, 20, 5);
  camera.eye = Vec3(10, 10, 7);
  const PlanePatch wall = plane_patch({Vec3(-2, 0, 0), -24}, camera, 1);  // x = 12, from its left
  CHECK(wall.kind == PlanePatch::Kind::wall);
  CHECK_FALSE(wall.seen_from_behind);
  CHECK(wall.center.x() == Approx(2));
  CHECK(wall.center.dot(wall.normal) == Approx(wall.offset));
  CHECK(wall.v.z() == Approx(1));
  CHECK(plane_patch({Vec3(1, 0, 0), 12}, camera, 1).seen_from_behind);
  CHECK(plane_patch({Vec3(0, 0, 1), 0}, camera, 1).kind == PlanePatch::Kind::floor);
  const PlanePatch ramp = plane_patch({Vec3(-0.5, 0, 1), 0}, camera, 1);
  CHECK(ramp.kind == PlanePatch::Kind::ramp);
  CHECK(ramp.v.x() > 0.4F);  // uphill
  CHECK(ramp.v.z() > 0.4F);
}

TEST_CASE("the visible polygon of a plane ends at the other planes, with an edge along each") {
  Camera camera;
  camera.target = Vec3(0, 0, 1);
  camera.eye = Vec3(-1, -6, 3);
  const std::vector<PlanePatch> patches{plane_patch({Vec3::UnitZ(), 0}, camera, 1),
                                        plane_patch({-Vec3::UnitX(), -0.5}, camera, 1)};
  const std::vector<Vec3f> floor = visible_polygon(patches, 0);
  CHECK(floor.size() == 4);
  float right = -1e9F;
  for (const Vec3f& p : floor) {
    right = std::max(right, p.x());
    CHECK(p.z() == Approx(-1));
  }
  CHECK(right == Approx(0.5));
  const auto edges = plane_edges(patches, 0, 0.01F);
  CHECK(edges.size() > 4);
  for (const SpringInstance& edge : edges) CHECK(edge.a.x() == Approx(0.5));
  CHECK(plane_edges({patches[0]}, 0, 0.01F).empty());
  CHECK(clipped(floor, Vec3f::UnitZ(), 0).empty());
}

TEST_CASE("a cut face moves with its body") {
  const TriangleMesh mesh = dumbbell_mesh(16);
  const Mat3 turn = Eigen::AngleAxisd(0.8, Vec3(1, 2, 3).normalized()).toRotationMatrix();
  const Vec3 shift(4, 5, 6);
  std::vector<Vec3> x;
  for (const Vec3& p : mesh.positions) x.emplace_back(turn * p + shift);
  DrawnBody body;
  body.surface = &mesh;
  body.surface_positions = &x;
  body.style.cut = DrawnPlane{Vec3(0, 2, 0), 0.06};  // y >= 0.03 is kept
  const Eigen::Vector4f face = cut_face(body, shift);
  const Vec3 wanted = turn * -Vec3::UnitY();
  CHECK((face.head<3>() - wanted.cast<float>()).norm() < 1e-5F);
  CHECK(face.w() == Approx(-0.03).margin(1e-6));
  const std::vector<float> kept = kept_distances(body);
  for (std::size_t i = 0; i < kept.size(); ++i)
    CHECK(kept[i] == Approx(mesh.positions[i].y() - 0.03).margin(1e-6));
}

TEST_CASE("the edges of a box are its twelve sides") {
  DrawnBox box;
  box.half_size = Vec3(1, 2, 3);
  double length = 0;
  const auto edges = box_edges(box, Vec3::Zero(), Colour{}, 0.1F);
  for (const SpringInstance& edge : edges) length += static_cast<double>((edge.b - edge.a).norm());
  CHECK(edges.size() == 12);
  CHECK(length == Approx(4 * (2 + 4 + 6)));
}
