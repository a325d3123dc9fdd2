#include <catch2/catch.hpp>

#include "elastic/loads.hpp"

using namespace springlod;
using namespace springlod::elastic;

namespace {

/// A bar of nodes 1 m apart, with springs between nodes closer than 1.5 m; all nodes are border
/// nodes.
MassSpringModel block(int width, int depth, int height) {
  MassSpringModel bar;
  bar.materials.resize(1);
  for (int z = 0; z < height; ++z)
    for (int y = 0; y < depth; ++y)
      for (int x = 0; x < width; ++x) bar.rest.emplace_back(x, y, z);
  const std::size_t n = bar.rest.size();
  bar.mass.assign(n, 1);
  bar.volume.assign(n, 1);
  bar.contact_area.assign(n, 1);
  bar.border.assign(n, 1);
  bar.material.assign(n, 0);
  for (std::uint32_t a = 0; a < n; ++a)
    for (std::uint32_t b = a + 1; b < n; ++b) {
      const double length = (bar.rest[b] - bar.rest[a]).norm();
      if (length > 1.5) continue;
      bar.a.push_back(a);
      bar.b.push_back(b);
      bar.rest_length.push_back(length);
      bar.stiffness.push_back(1);
      bar.damping.push_back(0);
    }
  return bar;
}

/// A bar of 12 x 4 x 4 nodes, whose middle third has another material.
MassSpringModel striped_bar() {
  MassSpringModel bar = block(12, 4, 4);
  bar.materials.resize(2, bar.materials.front());
  bar.materials[0].name = "rod";
  bar.materials[1].name = "rubber";
  for (std::uint32_t i = 0; i < bar.node_count(); ++i)
    bar.material[i] = bar.rest[i].x() > 3.5 && bar.rest[i].x() < 7.5 ? 1 : 0;
  return bar;
}

}  // namespace

TEST_CASE("A body of one material region has no piece loads") {
  CHECK(piece_loads(block(4, 4, 4)).empty());
}

TEST_CASE("Each material region is loaded separately") {
  const MassSpringModel bar = striped_bar();
  const std::vector<StaticLoad> loads = piece_loads(bar);
  REQUIRE(loads.size() == 27);  // nine on each of two rods and the rubber between
  CHECK(loads[0].name.rfind("stretch x of ", 0) == 0);
  for (const StaticLoad& load : loads) {
    REQUIRE(load.force.size() == bar.node_count());
    double amount = 0;
    std::uint32_t pulled = 0;
    for (const Vec3& force : load.force) {
      amount += force.norm();
      if (force.norm() > 0) ++pulled;
    }
    CHECK(amount == Approx(1));
    CHECK(pulled <= 64);
  }
}

TEST_CASE("The largest regions are loaded, also inside, and no small ones") {
  MassSpringModel bar = striped_bar();
  CHECK(piece_loads(bar, {.most_regions = 2}).size() == 18);
  CHECK(piece_loads(bar, {.least_nodes = 65}).empty());
  for (std::uint32_t i = 0; i < bar.node_count(); ++i)
    if (bar.material[i] == 1) bar.border[i] = 0;
  CHECK(piece_loads(bar).size() == 27);
}
