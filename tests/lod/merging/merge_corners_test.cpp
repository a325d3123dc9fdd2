#include "lod/merging/merge_corners.hpp"

#include <algorithm>
#include <map>
#include <numeric>
#include <random>

#include <catch2/catch.hpp>

#include "lod/build.hpp"
#include "lod/calibration/second_moments.hpp"
#include "lod/grouping/grouping.hpp"
#include "lod/merging/merge.hpp"
#include "lod/refill.hpp"
#include "tests/support/bodies.hpp"
#include "tests/support/corners.hpp"
#include "tests/support/models.hpp"
#include "voxelize/random/random.hpp"
#include "voxelize/refill.hpp"

using namespace springlod;
using namespace springlod::lod;
using test::block;
using test::check_corners;

namespace {

using Four = std::array<std::uint32_t, 4>;

/// A lattice of two materials at jittered positions, with the corners that are not flat there.
MassSpringModel jittered(std::uint64_t seed, int n = 7) {
  std::vector<test::Cell> cells;
  std::mt19937_64 random(seed);
  for (int z = 0; z < n; ++z)
    for (int y = 0; y < n; ++y)
      for (int x = 0; x < n; ++x)
        if (test::uniform(random) < 0.95)
          cells.emplace_back(voxelize::CellIndex{x, y, z},
                             static_cast<std::uint16_t>(x < n / 2 ? 0 : 1));
  MassSpringModel m =
      voxelize::build_lattice(test::grid_of(cells, 1,
                                            {test::material("soft", 1e5, 1000, 0.001),
                                             test::material("stiff", 1e6, 1000, 0.001)}))
          .model;
  for (Vec3& x : m.rest)
    x += 0.3 * Vec3(test::uniform(random), test::uniform(random), test::uniform(random));
  for (std::uint32_t s = 0; s < m.spring_count(); ++s)
    m.rest_length[s] = (m.rest[m.b[s]] - m.rest[m.a[s]]).norm();
  settle_corners(m.corners, m.rest);
  check_corners(m);
  return m;
}

/// The sets of four groups of the fine corners, and E of each.
std::map<Four, std::vector<double>> sets_of(const MassSpringModel& fine, const Groups& groups) {
  std::map<Four, std::vector<double>> sets;
  for (const Corner& corner : fine.corners) {
    Four set{};
    for (unsigned n = 0; n < 4; ++n) set[n] = groups.of[corner.node[n]];
    std::sort(set.begin(), set.end());
    if (std::adjacent_find(set.begin(), set.end()) == set.end()) sets[set].push_back(corner.young);
  }
  return sets;
}

}  // namespace

TEST_CASE("Merging two nodes of a cell leaves the corners between different groups") {
  const MassSpringModel cell = block(1, 1, 1, voxelize::LatticeStyle::corners);
  const MassSpringModel level = merge(cell, groups_from_sets(cell, {{0, 1}}));
  check_corners(level);
  // Both nodes of the edge lose their corners. The corners of the other six nodes remain, those of
  // the four neighbours with one edge moved.
  CHECK(level.corners.size() == 6);
  for (const Corner& corner : level.corners) CHECK(corner.young == cell.corners[0].young);
}

TEST_CASE("Merging no nodes keeps all corners") {
  const MassSpringModel m = jittered(1, 4);
  CHECK(merge(m, identity_groups(m.node_count())).corners == m.corners);
}

TEST_CASE("A merged level has a corner for each set of four groups that is not flat") {
  for (std::uint64_t seed = 1; seed <= 8; ++seed) {
    CAPTURE(seed);
    const MassSpringModel fine = jittered(seed);
    const Groups groups = group_nodes(fine, {.seed = seed});
    const MassSpringModel level = merge(fine, groups);
    check_corners(level);
    std::map<Four, std::vector<double>> sets = sets_of(fine, groups);
    for (const Corner& corner : level.corners) {
      Four set = corner.node;
      std::sort(set.begin(), set.end());
      const auto found = sets.find(set);
      REQUIRE(found != sets.end());
      const auto [least, most] = std::minmax_element(found->second.begin(), found->second.end());
      CHECK(corner.young >= *least);
      CHECK(corner.young <= *most);
      sets.erase(found);
    }
    // Those that are left out are flat at each of their apexes.
    for (const Corner& corner : fine.corners) {
      Four set{};
      for (unsigned n = 0; n < 4; ++n) set[n] = groups.of[corner.node[n]];
      Corner merged{set, 1};
      std::sort(set.begin(), set.end());
      if (sets.count(set) > 0) REQUIRE_FALSE(orient(merged, level.rest));
    }
    CHECK(level.corners.size() > 3 * level.node_count());
    CHECK(merge_springs(fine, groups, relink(SpringRows(fine), groups)).corners.empty());
  }
}

TEST_CASE("Equal corners become one with the mean of their moduli") {
  // Two tetrahedra side by side, of which each node is merged with that of the other.
  std::vector<Vec3> rest;
  for (const double x : {0.0, 1.0})
    for (const Vec3& at : {Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(0, 0, 1)})
      rest.push_back(at + 0.1 * x * Vec3::Ones());
  MassSpringModel m = test::table_model(rest, std::vector<double>(8, 1),
                                        {{0, 1, 1},
                                         {0, 2, 1},
                                         {0, 3, 1},
                                         {1, 2, 1},
                                         {1, 3, 1},
                                         {2, 3, 1},
                                         {4, 5, 1},
                                         {4, 6, 1},
                                         {4, 7, 1},
                                         {5, 6, 1},
                                         {5, 7, 1},
                                         {6, 7, 1}});
  m.corners = {{{0, 1, 2, 3}, 1e6}, {{4, 5, 6, 7}, 4e6}};
  const MassSpringModel level = merge(m, {{0, 1, 2, 3, 0, 1, 2, 3}, 4});
  REQUIRE(level.corners.size() == 1);
  CHECK(level.corners[0] == Corner{{0, 1, 2, 3}, 2.5e6});

  // With another apex, the lowest one is kept.
  m.corners = {{{0, 1, 2, 3}, 1e6}, {{5, 4, 7, 6}, 4e6}};
  REQUIRE_NOTHROW(validate(m));
  const MassSpringModel other = merge(m, {{0, 1, 2, 3, 0, 1, 2, 3}, 4});
  REQUIRE(other.corners.size() == 1);
  CHECK(other.corners[0] == Corner{{0, 1, 2, 3}, 1e6});
}

TEST_CASE("Corners are judged at the positions of the merged nodes") {
  const MassSpringModel m = jittered(2, 4);
  const Groups groups = identity_groups(m.node_count());
  MassSpringModel moved = m;
  SECTION("turned over: positive again") {
    for (Vec3& x : moved.rest) x.x() *= -1;
    moved.corners = merge_corners(m.corners, groups, moved.rest);
    CHECK(moved.corners.size() == m.corners.size());
  }
  SECTION("sheared: some are flat and left out") {
    for (Vec3& x : moved.rest) x.z() += 4 * x.x();
    moved.corners = merge_corners(m.corners, groups, moved.rest);
    CHECK(moved.corners.size() < m.corners.size());
    CHECK(moved.corners.size() > 0);
  }
  SECTION("in a plane: none") {
    for (Vec3& x : moved.rest) x.x() = 0;
    CHECK(merge_corners(m.corners, groups, moved.rest).empty());
    return;
  }
  for (std::uint32_t s = 0; s < m.spring_count(); ++s)
    moved.rest_length[s] = (moved.rest[m.b[s]] - moved.rest[m.a[s]]).norm();
  check_corners(moved);
}

TEST_CASE("Every way to make levels gives valid corners") {
  const MassSpringModel base = GENERATE(test::rods(), test::ball(), jittered(3, 6));
  std::vector<SimplifyOptions> ways{
      {.levels = 3},
      {.levels = 3, .straight = true},
      {.levels = 2, .grouping = {.grouping = Grouping::priority_soft, .border = BorderRule::weak}},
      {.levels = 2, .grouping = {.border = BorderRule::strong}},
      {.levels = 2, .keep = {0.4, 0.15}, .grouping = {.grouping = Grouping::compact}},
      {.levels = 2, .keep = {0.5, 0.2}},
      {.levels = 1, .mass = MassRule::proximity},
      {.levels = 2, .calibrate = Calibrate::moduli}};
  for (const SimplifyOptions& way : ways) {
    const LodChain chain = simplify(base, way);
    CHECK(chain.levels[0].model.corners == base.corners);
    for (std::size_t n = 1; n < chain.levels.size(); ++n) {
      const MassSpringModel& level = chain.levels[n].model;
      CAPTURE(chain.levels[n].made_by, n);
      check_corners(level);
      CHECK(level.corner_count() > level.node_count());
      const std::map<Four, std::vector<double>> sets = sets_of(base, chain.levels[n].of_base);
      for (const Corner& corner : level.corners) {
        Four set = corner.node;
        std::sort(set.begin(), set.end());
        CHECK(sets.count(set) == 1);
      }
    }
  }
}

TEST_CASE("Restored second moments leave no corner flat or inverted") {
  const MassSpringModel base = jittered(5);
  for (const std::uint64_t seed : {1U, 2U, 3U}) {
    LodChain chain = simplify(base, {.levels = 2, .grouping = {.seed = seed}});
    Level& level = chain.levels[2];
    const std::size_t before = level.model.corners.size();
    restore_second_moments(base, level.of_base, level.model);
    check_corners(level.model);
    CHECK(level.model.corners.size() <= before);
    CHECK(level.model.corners.size() > before / 2);
  }
}

TEST_CASE("A calibrated level keeps its corners for any number of threads") {
  const MassSpringModel base = block(6, 4, 4);
  const auto calibrated = [&](std::uint32_t threads) {
    SimplifyOptions options{.levels = 1, .keep = {0.4}, .calibrate = Calibrate::modes};
    options.calibration.fit.iterations = 2;
    options.calibration.threads = threads;
    return simplify(base, options).levels[1].model;
  };
  const MassSpringModel level = calibrated(1);
  check_corners(level);
  CHECK(level.corner_count() > level.node_count());
  for (const Corner& corner : level.corners) CHECK(corner.young == base.corners[0].young);
  CHECK(calibrated(3).corners == level.corners);
}

TEST_CASE("A base without corners gives levels without corners") {
  MassSpringModel base = test::rods();
  base.corners.clear();
  for (const Level& level : simplify(base, {.levels = 2}).levels)
    CHECK(level.model.corners.empty());
}
