#include "voxelize/lattice/hinges.hpp"

#include <random>

#include <catch2/catch.hpp>

#include "tests/voxelize/grids.hpp"
#include "voxelize/lattice/lattice.hpp"

namespace springlod::voxelize {

using namespace springlod::test;

namespace {

LatticeModel build(const MaterialGrid& grid, HingePolicy policy) {
  return build_lattice(grid, {LatticeStyle::corners, policy});
}

}  // namespace

TEST_CASE("Two cells that touch along an edge form a hinge in the middle of that edge") {
  const auto lattice = build(grid_of({{0, 0, 0}, {1, 1, 0}}), HingePolicy::report);
  REQUIRE(lattice.hinges.size() == 1);
  CHECK(lattice.hinges[0].along_edge);
  CHECK(lattice.hinges[0].position == Vec3(1, 1, 0.5));
  CHECK(lattice.model.node_count() == 14);
  CHECK(lattice.components == 1);
}

TEST_CASE("Two cells that touch along an edge in any of the 12 directions form one hinge") {
  for (int axis = 0; axis < 3; ++axis)
    for (const int u : {-1, 1})
      for (const int v : {-1, 1}) {
        CellIndex other{0, 0, 0};
        other[(axis + 1) % 3] = u;
        other[(axis + 2) % 3] = v;
        const auto lattice = build(grid_of({{0, 0, 0}, other}), HingePolicy::report);
        REQUIRE(lattice.hinges.size() == 1);
        CHECK(lattice.hinges[0].along_edge);
      }
}

TEST_CASE("Two cells that touch at a corner form a hinge at that corner") {
  for (const int x : {-1, 1})
    for (const int y : {-1, 1}) {
      const auto lattice = build(grid_of({{0, 0, 0}, {x, y, 1}}), HingePolicy::report);
      REQUIRE(lattice.hinges.size() == 1);
      CHECK_FALSE(lattice.hinges[0].along_edge);
      CHECK(lattice.hinges[0].position == Vec3(x > 0 ? 1 : 0, y > 0 ? 1 : 0, 1));
    }
}

TEST_CASE(
    "A contact along an edge or at a corner is no hinge if faces around it connect the cells") {
  CHECK(build(box_grid(3, 3, 3), HingePolicy::report).hinges.empty());
  CHECK(build(grid_of({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}}), HingePolicy::report).hinges.empty());
  CHECK(build(grid_of({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {1, 1, 1}}), HingePolicy::report)
            .hinges.empty());
}

TEST_CASE("An edge whose cells are connected around one end only is still a hinge") {
  // The two lower cells touch along an edge; the slab on top of them connects them.
  const auto grid = grid_of({{0, 0, 0}, {1, 1, 0}, {0, 0, 1}, {1, 0, 1}, {0, 1, 1}, {1, 1, 1}});
  const auto lattice = build(grid, HingePolicy::report);
  REQUIRE(lattice.hinges.size() == 1);
  CHECK(lattice.hinges[0].position == Vec3(1, 1, 0.5));
  const auto apart = build(grid, HingePolicy::separate);
  CHECK(apart.model.node_count() == lattice.model.node_count() + 1);
  CHECK(apart.components == 1);
}

TEST_CASE("Filling a hinge connects its cells by faces") {
  MaterialGrid edge = grid_of({{0, 0, 0}, {1, 1, 0}});
  edge.material = {1, 1};
  const auto filled_edge = build(edge, HingePolicy::fill);
  CHECK(filled_edge.filled_cells == 1);
  CHECK(filled_edge.hinges.size() == 1);  // reported, although it is filled
  CHECK(filled_edge.components == 1);
  CHECK(mass_properties(filled_edge.model).mass == Approx(3 * 2500));

  MaterialGrid corner = grid_of({{0, 0, 0}, {1, 1, 1}});
  CHECK(fill_hinges(corner) == 2);
  CHECK(corner.cells.size() == 4);
  CHECK(corner.depth.size() == 4);
  CHECK_NOTHROW(validate(corner));
  CHECK(find_hinges(corner, corner_nodes(corner.cells)).empty());
}

TEST_CASE("Separating a hinge duplicates the shared nodes and disconnects the cells") {
  const auto edge = build(grid_of({{0, 0, 0}, {1, 1, 0}}), HingePolicy::separate);
  CHECK(edge.model.node_count() == 16);
  CHECK(edge.model.spring_count() == 48);
  CHECK(edge.components == 2);
  const auto corner = build(grid_of({{0, 0, 0}, {1, 1, 1}}), HingePolicy::separate);
  CHECK(corner.model.node_count() == 16);
  CHECK(corner.components == 2);
  CHECK(mass_properties(corner.model).mass == Approx(2000).epsilon(1e-14));
}

TEST_CASE("Both policies leave no hinge in a random set of cells") {
  std::mt19937_64 random(7);
  std::vector<CellIndex> cells;
  for (int z = 0; z < 12; ++z)
    for (int y = 0; y < 12; ++y)
      for (int x = 0; x < 12; ++x)
        if (random() % 3 == 0) cells.push_back({x, y, z});
  MaterialGrid grid = grid_of(cells);
  const CornerNodes nodes = corner_nodes(grid.cells);
  CHECK(find_hinges(grid, nodes).size() > 100);
  CHECK(find_hinges(grid, separate_clusters(nodes)).empty());
  CHECK(fill_hinges(grid) > 0);
  CHECK_NOTHROW(validate(grid));
  CHECK(find_hinges(grid, corner_nodes(grid.cells)).empty());
}

}  // namespace springlod::voxelize
