#include "tests/support/corners.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numeric>

#include <catch2/catch.hpp>

#include "tests/voxelize/grids.hpp"
#include "voxelize/lattice/lattice.hpp"
#include "voxelize/random/random.hpp"
#include "voxelize/refill.hpp"

namespace springlod::voxelize {
namespace {

using test::box_grid;
using test::check_corners;
using test::grid_of;

MassSpringModel lattice(const MaterialGrid& grid, LatticeStyle style = LatticeStyle::corners,
                        HingePolicy hinges = HingePolicy::report) {
  return build_lattice(grid, {.style = style, .hinges = hinges}).model;
}

/// Sum of V0 / 8 [m3].
double corner_volumes(const MassSpringModel& model) {
  double sum = 0;
  for (const Corner& corner : model.corners) sum += corner_volume(corner, model.rest) / 8;
  return sum;
}

/// A block with a hole through it and one inside.
MaterialGrid grid_with_holes() {
  std::vector<CellIndex> cells;
  for (int z = 0; z < 6; ++z)
    for (int y = 0; y < 5; ++y)
      for (int x = 0; x < 5; ++x)
        if (!(x == 2 && y == 1) && !(x == 2 && y == 3 && z == 3)) cells.push_back({x, y, z});
  return grid_of(cells, 0.01);
}

TEST_CASE("A single cell has eight corners of its volume and modulus") {
  const MassSpringModel model = lattice(box_grid(1, 1, 1, 0.1));
  check_corners(model);
  REQUIRE(model.corners.size() == 8);
  for (std::uint32_t c = 0; c < 8; ++c) {
    CHECK(model.corners[c].node[0] == c);
    CHECK(corner_volume(model.corners[c], model.rest) == Approx(1e-3));
    CHECK(model.corners[c].young == 1e6);
  }
  CHECK(lattice(box_grid(1, 1, 1), LatticeStyle::centers).corners.empty());
}

TEST_CASE("A corners lattice of n cells has 8 n corners, also around holes") {
  for (const MaterialGrid& grid : {box_grid(4, 3, 2, 0.1), grid_with_holes()}) {
    const MassSpringModel model = lattice(grid);
    check_corners(model);
    CHECK(model.corners.size() == 8 * grid.cells.size());
    CHECK(corner_volumes(model) == Approx(mass_properties(model).volume));
    for (const Corner& corner : model.corners)
      REQUIRE(corner_shape(corner, model.rest) == Approx(1));
  }
}

TEST_CASE("A centers lattice has eight corners for each cube of eight cells") {
  const MassSpringModel box = lattice(box_grid(5, 4, 3, 0.1), LatticeStyle::centers);
  check_corners(box);
  CHECK(box.corners.size() == 8 * 4 * 3 * 2);
  const MassSpringModel holes = lattice(grid_with_holes(), LatticeStyle::centers);
  check_corners(holes);
  CHECK(holes.corners.size() > 0);
  // Three cells around a fourth: the cube is not full, but the corner between them is.
  const MassSpringModel four =
      lattice(grid_of({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}), LatticeStyle::centers);
  CHECK(four.corners == std::vector<Corner>{{{0, 1, 2, 3}, 1e6}});
  CHECK(lattice(box_grid(5, 5, 1), LatticeStyle::centers).corners.empty());
}

TEST_CASE("Corners have the modulus of their cell, or the harmonic mean of their nodes") {
  MaterialGrid grid = box_grid(2, 2, 2);
  for (std::size_t n = 0; n < grid.cells.size(); ++n) grid.material[n] = grid.cells[n][2] == 1;
  std::map<double, int> count;
  for (const Corner& corner : lattice(grid).corners) ++count[corner.young];
  CHECK(count == std::map<double, int>{{1e6, 32}, {4e6, 32}});
  count.clear();
  const MassSpringModel centers = lattice(grid, LatticeStyle::centers);
  check_corners(centers);
  // Each corner has three nodes in one layer and one in the other.
  for (const Corner& corner : centers.corners) ++count[std::round(corner.young)];
  const double mostly_soft = std::round(4 / (3 / 1e6 + 1 / 4e6));
  const double mostly_stiff = std::round(4 / (1 / 1e6 + 3 / 4e6));
  CHECK(count == std::map<double, int>{{mostly_soft, 4}, {mostly_stiff, 4}});
}

TEST_CASE("Cells that touch at an edge keep their own corners for every treatment of hinges") {
  const MaterialGrid grid = grid_of({{0, 0, 0}, {1, 1, 0}});
  const MassSpringModel reported = lattice(grid);
  check_corners(reported);
  CHECK(reported.corners.size() == 16);
  const MassSpringModel separate = lattice(grid, LatticeStyle::corners, HingePolicy::separate);
  check_corners(separate);
  CHECK(separate.corners.size() == 16);
  CHECK(separate.node_count() == 16);
  const MassSpringModel filled = lattice(grid, LatticeStyle::corners, HingePolicy::fill);
  check_corners(filled);
  CHECK(filled.corners.size() == 24);
}

TEST_CASE("Without volumes there are no corners, and all else is the same") {
  const MaterialGrid grid = box_grid(5, 5, 5, 0.1);
  for (const LatticeStyle style : {LatticeStyle::corners, LatticeStyle::centers}) {
    const MassSpringModel bare = build_lattice(grid, {.style = style, .volumes = false}).model;
    const MassSpringModel with = lattice(grid, style);
    CHECK(bare.corners.empty());
    CHECK(bare.stiffness == with.stiffness);
    CHECK(bare.rest == with.rest);
  }
  const MassSpringModel bare = build_random(grid, {.nodes = 100, .volumes = false}).model;
  CHECK(bare.corners.empty());
  CHECK(bare.stiffness == build_random(grid, {.nodes = 100}).model.stiffness);
  for (const RefillStyle style : {RefillStyle::lattice, RefillStyle::random}) {
    const auto levels = refill_levels(grid, {.nodes = {60}, .style = style, .volumes = false});
    CHECK(levels[0].model.corners.empty());
  }
}

/// For each inner node, the octants around it that a tetrahedron of a corner reaches into.
std::vector<std::array<bool, 8>> covered_octants(const MassSpringModel& model) {
  constexpr int kDirections = 400;
  constexpr double kGoldenAngle = 2.399963;  // [rad]; spreads the directions evenly
  std::vector<std::array<bool, 8>> covered(model.node_count());
  for (const Corner& corner : model.corners)
    for (unsigned at = 0; at < 4; ++at) {
      auto nodes = corner.node;
      std::swap(nodes[0], nodes[at]);
      const Vec3 u = model.rest[nodes[1]] - model.rest[nodes[0]];
      const Vec3 v = model.rest[nodes[2]] - model.rest[nodes[0]];
      const Vec3 w = model.rest[nodes[3]] - model.rest[nodes[0]];
      const double volume = u.dot(v.cross(w));
      for (int i = 0; i < kDirections; ++i) {
        const double z = 1 - (2 * i + 1.0) / kDirections;
        const double r = std::sqrt(1 - z * z);
        const Vec3 d(r * std::cos(kGoldenAngle * i), r * std::sin(kGoldenAngle * i), z);
        if (volume * d.dot(v.cross(w)) < 0 || volume * d.dot(w.cross(u)) < 0 ||
            volume * d.dot(u.cross(v)) < 0)
          continue;
        const unsigned octant =
            (d.x() > 0 ? 1U : 0U) | (d.y() > 0 ? 2U : 0U) | (d.z() > 0 ? 4U : 0U);
        covered[nodes[0]][octant] = true;
      }
    }
  return covered;
}

TEST_CASE("Every inner node of a random model has corners on all sides") {
  MaterialGrid grid = box_grid(8, 8, 8, 0.01);
  for (std::size_t n = 0; n < grid.cells.size(); ++n) grid.material[n] = grid.cells[n][2] >= 5;
  for (const std::uint64_t seed : {1U, 2U}) {
    const MassSpringModel model = build_random(grid, {.nodes = 500, .seed = seed}).model;
    check_corners(model);
    const auto covered = covered_octants(model);
    int inner = 0;
    for (std::uint32_t i = 0; i < model.node_count(); ++i) {
      if (model.border[i] != 0) continue;
      ++inner;
      CHECK(std::count(covered[i].begin(), covered[i].end(), true) == 8);
    }
    CHECK(inner > 100);
    // E V0 / 8 then adds up to about the work of a body of cells.
    CHECK(corner_volumes(model) == Approx(mass_properties(model).volume).epsilon(0.2));
    for (const Corner& corner : model.corners) {
      CHECK(corner.young >= 1e6);
      CHECK(corner.young <= 4e6);
    }
  }
}

TEST_CASE("Refilled levels have corners at their scaled positions") {
  const MaterialGrid grid = box_grid(7, 6, 5, 0.01);
  for (const RefillStyle style : {RefillStyle::lattice, RefillStyle::random})
    for (const LatticeStyle of : {LatticeStyle::corners, LatticeStyle::centers})
      for (const Level& level :
           refill_levels(grid, {.nodes = {120, 50}, .style = style, .lattice = of})) {
        check_corners(level.model);
        CHECK(level.model.corners.size() > level.model.node_count());
      }
}

}  // namespace
}  // namespace springlod::voxelize
