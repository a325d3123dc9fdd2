// Merged levels have no mechanisms that their base does not have.

#include "lod/merging/mechanisms.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include <catch2/catch.hpp>

#include "elastic/zero_modes.hpp"
#include "lod/build.hpp"
#include "lod/merging/rigid_stars.hpp"
#include "tests/support/bodies.hpp"
#include "tests/support/lattices.hpp"
#include "tests/support/models.hpp"

using namespace springlod;
using namespace springlod::lod;
using springlod::test::Cell;

namespace {

void add_box(std::vector<Cell>& cells, const voxelize::CellIndex& from,
             const voxelize::CellIndex& size) {
  for (int x = 0; x < size[0]; ++x)
    for (int y = 0; y < size[1]; ++y)
      for (int z = 0; z < size[2]; ++z)
        cells.push_back({{from[0] + x, from[1] + y, from[2] + z}, 0});
}

MassSpringModel body_of(std::vector<Cell> cells) {
  const voxelize::MaterialGrid grid =
      test::grid_of(std::move(cells), 0.01, {test::material("rubber", 1e6, 1000, 1e-4)});
  return voxelize::build_lattice(grid, {.style = voxelize::LatticeStyle::corners}).model;
}

MassSpringModel bar(int nx, int ny, int nz) {
  return test::block(nx, ny, nz, voxelize::LatticeStyle::corners);
}

std::vector<std::pair<std::string, MassSpringModel>> slender_bodies() {
  std::vector<Cell> l;
  add_box(l, {0, 0, 0}, {2, 2, 16});
  add_box(l, {2, 0, 0}, {12, 2, 2});
  std::vector<Cell> hammer;
  add_box(hammer, {0, 0, 0}, {2, 2, 16});
  add_box(hammer, {-3, -1, 16}, {8, 4, 4});
  std::vector<Cell> thin_hammer;
  add_box(thin_hammer, {0, 0, 0}, {1, 1, 12});
  add_box(thin_hammer, {-3, -1, 12}, {8, 4, 4});
  std::vector<Cell> ring;
  for (int x = 0; x < 14; ++x)
    for (int y = 0; y < 14; ++y) {
      const double radius = std::hypot(x - 6.5, y - 6.5);
      if (radius > 5 && radius < 7) add_box(ring, {x, y, 0}, {1, 1, 2});
    }
  return {{"1x1", bar(1, 1, 20)},
          {"1x2", bar(1, 2, 20)},
          {"2x2", bar(2, 2, 20)},
          {"2x3", bar(2, 3, 20)},
          {"short 1x1", bar(1, 1, 6)},
          {"L", body_of(std::move(l))},
          {"hammer", body_of(std::move(hammer))},
          {"thin hammer", body_of(std::move(thin_hammer))},
          {"ring", body_of(std::move(ring))}};
}

std::uint32_t mechanisms(const MassSpringModel& model) {
  std::uint32_t count = 0;
  for (const elastic::ComponentModes& part : elastic::zero_modes(model))
    count += part.zero_modes - part.expected;
  return count;
}

}  // namespace

TEST_CASE("Levels of slender bodies have no mechanisms, by any grouping and border rule") {
  for (const auto& [name, base] : slender_bodies()) {
    REQUIRE(mechanisms(base) == 0);
    for (const Grouping grouping : {Grouping::compact, Grouping::standard, Grouping::priority_soft})
      for (const BorderRule border : {BorderRule::none, BorderRule::weak}) {
        const LodChain chain =
            simplify(base, {.levels = 3, .grouping = {.grouping = grouping, .border = border}});
        for (const Level& level : chain.levels) {
          CAPTURE(name, to_string(grouping), to_string(border), level.made_by,
                  level.model.node_count());
          CHECK(mechanisms(level.model) == 0);
          CHECK_NOTHROW(validate(level.model));
        }
      }
  }
}

TEST_CASE("Regrouping keeps the number of nodes and the mass, and says how many it regrouped") {
  const MassSpringModel base = bar(1, 1, 20);
  const SimplifyOptions usual{.levels = 1, .grouping = {.grouping = Grouping::compact}};
  const Level level = simplify(base, usual).levels[1];
  CHECK(level.model.node_count() == 38);  // 0.45 of 84
  CHECK_THAT(level.made_by, Catch::Matchers::Contains("nodes regrouped to stay rigid"));
  double mass = 0;
  double base_mass = 0;
  for (const double m : level.model.mass) mass += m;
  for (const double m : base.mass) base_mass += m;
  CHECK(mass == Approx(base_mass));
  SimplifyOptions raw = usual;
  raw.guards = false;
  CHECK(mechanisms(simplify(base, raw).levels[1].model) > 0);
}

TEST_CASE("A sound step and a rope are left as they are") {
  const MassSpringModel solid = bar(4, 4, 8);
  const SpringRows rows(solid);
  const Groups all = identity_groups(solid.node_count());
  const RegroupedStep kept =
      without_mechanisms(solid, rows, guard_groups(solid, rows, all, {}), 1000, {});
  CHECK(kept.regrouped == 0);
  CHECK(kept.groups.count == solid.node_count());

  const MassSpringModel rope = test::chain_of_nodes(12);
  const SpringRows rope_rows(rope);
  Groups pairs;
  for (std::uint32_t i = 0; i < 12; ++i) pairs.of.push_back(i / 2);
  pairs.count = 6;
  const RegroupedStep coarse =
      without_mechanisms(rope, rope_rows, {pairs, relink(rope_rows, pairs)}, 12, {});
  CHECK(coarse.regrouped == 0);
  CHECK(coarse.groups.of == pairs.of);
}

TEST_CASE("A step that cannot be mended below the wanted number is returned as it was") {
  const MassSpringModel base = bar(1, 1, 6);
  const SpringRows rows(base);
  Groups three;  // a chain of three nodes
  for (std::uint32_t i = 0; i < base.node_count(); ++i)
    three.of.push_back(static_cast<std::uint32_t>(base.rest[i].z() / 0.61 * 3));
  for (std::uint32_t& g : three.of) g = std::min(g, 2U);
  three.count = 3;
  const RegroupedStep same = without_mechanisms(base, rows, {three, relink(rows, three)}, 4, {});
  CHECK(same.regrouped == 0);
  CHECK(same.groups.of == three.of);
  const RegroupedStep more = without_mechanisms(base, rows, {three, relink(rows, three)}, 28, {});
  CHECK(more.regrouped == base.node_count());
  CHECK(more.groups.count > 3);
}

TEST_CASE("Stars: those of a solid are rigid, those of a hinge are not, and undo restores them") {
  RigidStars solid(bar(2, 2, 2));
  for (std::uint32_t i = 0; i < solid.size(); ++i) CHECK(solid.rigid(i));
  const std::vector<RigidStars::Link> links = solid.links(13);
  const Vec3 center = solid.center(13);
  RigidStars::Before before = solid.fuse(13, links.back().node);
  CHECK(solid.links(13).size() + 1 >= links.size());
  CHECK(solid.mass(13) > before.mass);
  solid.undo(std::move(before));
  CHECK(solid.center(13) == center);
  REQUIRE(solid.links(13).size() == links.size());
  for (std::size_t n = 0; n < links.size(); ++n) {
    CHECK(solid.links(13)[n].node == links[n].node);
    CHECK(solid.links(13)[n].tension == links[n].tension);
  }
  // Two cells with a common edge.
  const MassSpringModel hinged = body_of({{{0, 0, 0}, 0}, {{1, 1, 0}, 0}});
  RigidStars hinge(hinged);
  std::uint32_t floppy = 0;
  for (std::uint32_t i = 0; i < hinge.size(); ++i) floppy += hinge.rigid(i) ? 0 : 1;
  CHECK(floppy == 2);
}
