#include "lod/build.hpp"

#include <catch2/catch.hpp>

#include "base/error.hpp"
#include "elastic/zero_modes.hpp"
#include "lod/grouping/grouping.hpp"
#include "lod/merging/guard.hpp"
#include "lod/merging/merge.hpp"
#include "lod/transfer.hpp"
#include "tests/support/bodies.hpp"
#include "tests/support/models.hpp"

using namespace springlod;
using namespace springlod::lod;
using springlod::test::ball;
using springlod::test::block;
using springlod::test::random_model;
using springlod::test::rods;

TEST_CASE("The maps of a chain compose: every level is the base merged by its map") {
  const MassSpringModel base = rods();
  const LodChain chain = simplify(base, {.levels = 3});
  REQUIRE(chain.levels.size() == 4);
  for (const Level& level : chain.levels) {
    REQUIRE(level.of_base.of.size() == base.node_count());
    std::vector<double> mass(level.of_base.count, 0);
    std::vector<Vec3> moment(level.of_base.count, Vec3::Zero());
    for (std::uint32_t i = 0; i < base.node_count(); ++i) {
      mass[level.of_base.of[i]] += base.mass[i];
      moment[level.of_base.of[i]] += base.mass[i] * base.rest[i];
    }
    for (std::uint32_t g = 0; g < level.of_base.count; ++g) {
      REQUIRE(level.model.mass[g] == Approx(mass[g]).epsilon(1e-13));
      REQUIRE((level.model.rest[g] - moment[g] / mass[g]).norm() < 1e-12);
    }
  }
}

TEST_CASE("Guarded chains of beams and rods have no floppy nodes and stay connected") {
  std::uint32_t raw_mechanisms = 0;
  std::uint32_t guarded_mechanisms = 0;
  for (std::uint64_t seed = 1; seed <= 10; ++seed)
    for (const MassSpringModel& base : {block(4, 4, 20), rods()}) {
      for (const bool guards : {false, true}) {
        const LodChain chain =
            simplify(base, {.levels = 3, .grouping = {.seed = seed}, .guards = guards});
        for (std::size_t n = 1; n < chain.levels.size(); ++n) {
          const std::vector<elastic::ComponentModes> parts =
              elastic::zero_modes(chain.levels[n].model);
          REQUIRE(parts.size() == 1);
          if (parts[0].zero_modes > parts[0].expected)
            ++(guards ? guarded_mechanisms : raw_mechanisms);
        }
      }
    }
  CHECK(raw_mechanisms > 0);  // otherwise the test checks nothing
  CHECK(guarded_mechanisms == 0);
}

TEST_CASE("Guards leave a rope unchanged and a coarsened cube valid") {
  std::vector<Vec3> points;
  std::vector<springlod::test::TableSpring> springs;
  for (std::uint32_t i = 0; i < 20; ++i) {
    points.emplace_back(i, 0, 0);
    if (i > 0) springs.push_back({i - 1, i, 100});
  }
  const MassSpringModel rope =
      springlod::test::table_model(points, std::vector<double>(20, 1), springs);
  const GuardedGroups kept = guard_groups(rope, identity_groups(20), {});
  CHECK(kept.groups.count == 20);

  const LodChain cube = simplify(block(3, 3, 3), {.levels = 2});
  CHECK(cube.levels.back().model.node_count() >= 1);
  CHECK_NOTHROW(validate(cube.levels.back().model));
}

TEST_CASE("Under a strong border the guards change no border node") {
  const MassSpringModel base = block(5, 5, 5);
  const LodChain chain = simplify(base, {.levels = 1, .grouping = {.border = BorderRule::strong}});
  const Level& level = chain.levels[1];
  for (std::uint32_t i = 0; i < base.node_count(); ++i)
    if (base.border[i] != 0) REQUIRE(level.model.rest[level.of_base.of[i]] == base.rest[i]);
  CHECK(level.model.node_count() < base.node_count());
}

TEST_CASE("A level that cannot be coarser is an error that names the possible number") {
  const MassSpringModel two =
      springlod::test::table_model({{0, 0, 0}, {1, 0, 0}}, {1, 1}, {{0, 1, 1}});
  CHECK_THROWS_WITH(simplify(two, {.levels = 3}), Catch::Contains("use levels = 1"));
}

TEST_CASE("Levels of thin plates have the nearest number of nodes that the guards allow") {
  const Grouping grouping = GENERATE(Grouping::compact, Grouping::metis);
  for (const MassSpringModel& plate :
       {block(8, 8, 1, voxelize::LatticeStyle::corners), block(7, 7, 2), block(9, 9, 2)}) {
    SimplifyOptions options;
    options.levels = 2;
    options.grouping = {.grouping = grouping, .seed = 1};
    const LodChain chain = simplify(plate, options);
    const double base = plate.node_count();
    const double left[] = {chain.levels[1].model.node_count() / base,
                           chain.levels[2].model.node_count() / base};
    CHECK(left[0] == Approx(0.45).margin(0.05));
    CHECK(left[1] == Approx(0.2).margin(0.07));
  }
}

TEST_CASE("A plate coarsens until one node is left, however many nodes the guards fuse") {
  SimplifyOptions options;
  options.levels = 4;
  options.grouping = {.grouping = Grouping::compact, .seed = 1};
  // The guards leave fewer nodes in level 3 than are usual in level 4.
  CHECK(simplify(block(8, 8, 2), options).levels.back().model.node_count() < 5);
  options.levels = 8;
  CHECK_THROWS_WITH(simplify(block(8, 8, 2), options), Catch::Contains("use levels = "));
}

TEST_CASE("A number of nodes that the guards do not allow is an error that names one") {
  SimplifyOptions options;
  options.levels = 2;
  options.keep = {0.45, 0.2};
  options.grouping.grouping = Grouping::compact;
  CHECK_THROWS_WITH(
      simplify(block(5, 4, 2), options),
      Catch::Contains("keep asks for 8 nodes in level 2") && Catch::Contains("leave it out"));
}

TEST_CASE("Groups of a script are used unchanged, except by the guards") {
  const MassSpringModel base = block(4, 4, 4);
  SimplifyOptions options;
  options.levels = 1;
  options.guards = false;
  options.groups = [](const MassSpringModel& fine, const Groups&, std::uint32_t) {
    return groups_from_sets(fine, {{0, 1}});
  };
  options.straight = GENERATE(false, true);
  const LodChain chain = simplify(base, options);
  CHECK(chain.levels[1].model.node_count() == 63);
  CHECK(chain.levels[1].of_base.of[0] == chain.levels[1].of_base.of[1]);
}

TEST_CASE("Interpolation from a level to the base is exact for affine motions") {
  Mat3 f;
  f << 0.9, -0.4, 0.1, 0.5, 0.8, 0, 0.05, -0.2, 1.1;
  const Vec3 shift(3, -2, 5);
  for (const MassSpringModel& base : {ball(), rods(), random_model(6, 6)}) {
    const LodChain chain = simplify(base, {.levels = 2});
    for (std::uint32_t n = 0; n < 3; ++n) {
      std::vector<Vec3> moved;
      for (const Vec3& x : chain.levels[n].model.rest) moved.emplace_back(f * x + shift);
      const std::vector<Vec3> carried = interpolate(base_from_level(chain, n), moved);
      double worst = 0;
      for (std::uint32_t i = 0; i < base.node_count(); ++i)
        worst = std::max(worst, (carried[i] - (f * base.rest[i] + shift)).norm());
      CHECK(worst < 1e-9);
    }
  }
  CHECK_THROWS_AS(base_from_level(simplify(ball(), {.levels = 1}), 2), InputError);
}
