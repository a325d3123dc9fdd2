#include "lod/merging/merge.hpp"

#include <cmath>
#include <numeric>

#include <catch2/catch.hpp>

#include "base/error.hpp"
#include "lod/grouping/grouping.hpp"
#include "lod/merging/guard.hpp"
#include "tests/support/models.hpp"

using namespace springlod;
using namespace springlod::lod;
using springlod::test::random_model;
using springlod::test::table_model;

namespace {

MassSpringModel merge_sets(const MassSpringModel& m,
                           const std::vector<std::vector<std::uint32_t>>& sets) {
  return merge(m, groups_from_sets(m, sets));
}

std::vector<Vec3> on_axis(const std::vector<double>& x) {
  std::vector<Vec3> points;
  for (const double each : x) points.emplace_back(each, 0, 0);
  return points;
}

const std::vector<Vec3> kSquare{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}};
const MassSpringModel kCrossedSquare =
    table_model(kSquare, {1, 1, 1, 1},
                {{0, 1, 10}, {2, 3, 10}, {0, 2, 10}, {1, 3, 10}, {0, 3, 10}, {1, 2, 10}});

}  // namespace

TEST_CASE("Worked example 1: a chain merged by pairs") {
  const MassSpringModel m =
      table_model(on_axis({0, 1, 2, 3}), {1, 1, 1, 1}, {{0, 1, 100}, {1, 2, 100}, {2, 3, 100}});
  const MassSpringModel level = merge_sets(m, {{0, 1}, {2, 3}});
  REQUIRE(level.spring_count() == 1);
  CHECK(level.rest[0].x() == 0.5);
  CHECK(level.rest[1].x() == 2.5);
  CHECK(level.rest_length[0] == 2);
  CHECK(level.stiffness[0] == 50);
}

TEST_CASE("Worked example 2: the centre of mass determines the new length") {
  const MassSpringModel m = table_model(on_axis({0, 1, 2}), {1, 3, 2}, {{0, 1, 100}, {1, 2, 60}});
  const MassSpringModel level = merge_sets(m, {{0, 1}});
  REQUIRE(level.spring_count() == 1);
  CHECK(level.rest[0].x() == 0.75);
  CHECK(level.rest_length[0] == 1.25);
  CHECK(level.stiffness[0] == Approx(48).epsilon(1e-14));
}

TEST_CASE("Worked example 3: parallel springs add up, each with its own old length") {
  const MassSpringModel m = table_model({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {1, 1, 1},
                                        {{0, 1, 100}, {0, 2, 100}, {1, 2, 100}});
  const MassSpringModel level = merge_sets(m, {{0, 1}});
  REQUIRE(level.spring_count() == 1);
  CHECK(level.rest_length[0] == Approx(std::sqrt(1.25)).epsilon(1e-15));
  CHECK(level.stiffness[0] == Approx(100 * (1 + std::sqrt(2)) / std::sqrt(1.25)).epsilon(1e-14));
  CHECK(level.stiffness[0] == Approx(215.9338).epsilon(1e-6));
}

TEST_CASE("Worked example 4: a crossed square merged to one spring") {
  const MassSpringModel level = merge_sets(kCrossedSquare, {{0, 1}, {2, 3}});
  REQUIRE(level.spring_count() == 1);
  CHECK(level.rest_length[0] == 1);
  CHECK(level.stiffness[0] == Approx(20 + 20 * std::sqrt(2)).epsilon(1e-14));
  CHECK(level.stiffness[0] == Approx(48.2843).epsilon(1e-6));
}

TEST_CASE("Worked example 5: a triple merged keeps the springs of its ends") {
  const MassSpringModel m = table_model(on_axis({0, 1, 2, 5}), {1, 2, 1, 1},
                                        {{0, 1, 1}, {1, 2, 1}, {2, 3, 9}, {0, 3, 3}});
  const MassSpringModel level = merge_sets(m, {{0, 1, 2}});
  REQUIRE(level.spring_count() == 1);
  CHECK(level.rest[0].x() == 1);
  CHECK(level.rest_length[0] == 4);
  CHECK(level.stiffness[0] == Approx(10.5).epsilon(1e-14));
}

TEST_CASE("Worked example 6: crossing diagonals give neither infinity nor NaN") {
  const Groups diagonals = groups_from_sets(kCrossedSquare, {{0, 3}, {1, 2}});
  CHECK_THROWS_AS(merge(kCrossedSquare, diagonals), InputError);

  const GuardedGroups guarded = guard_groups(kCrossedSquare, diagonals, {});
  const MassSpringModel level = merge(kCrossedSquare, guarded.groups);
  validate(level);
  CHECK(level.node_count() == 1);
  CHECK(level.rest[0].isApprox(Vec3(0.5, 0.5, 0)));
}

TEST_CASE("Every merge keeps the invariants of the paper's rule") {
  for (std::uint64_t seed = 1; seed <= 12; ++seed) {
    const MassSpringModel fine = random_model(seed);
    const Groups groups = group_nodes(fine, {.seed = seed});
    const MassSpringModel level = merge(fine, groups);
    CAPTURE(seed);
    REQUIRE(level.node_count() < fine.node_count());
    REQUIRE_NOTHROW(validate(level));  // no self or double springs, all L > 0, finite

    const MassProperties before = mass_properties(fine);
    const MassProperties after = mass_properties(level);
    CHECK(after.mass == Approx(before.mass).epsilon(1e-14));
    CHECK(after.volume == Approx(before.volume).epsilon(1e-14));
    CHECK((after.center - before.center).norm() < 1e-13);

    double tension = 0;
    double damper_tension = 0;
    for (std::uint32_t s = 0; s < fine.spring_count(); ++s)
      if (groups.of[fine.a[s]] != groups.of[fine.b[s]]) {
        tension += fine.stiffness[s] * fine.rest_length[s];
        damper_tension += fine.damping[s] * fine.rest_length[s];
      }
    double new_tension = 0;
    double new_damper_tension = 0;
    for (std::uint32_t s = 0; s < level.spring_count(); ++s) {
      new_tension += level.stiffness[s] * level.rest_length[s];
      new_damper_tension += level.damping[s] * level.rest_length[s];
      CHECK(level.damping[s] / level.stiffness[s] == Approx(0.002).epsilon(1e-12));
    }
    CHECK(new_tension == Approx(tension).epsilon(1e-12));
    CHECK(new_damper_tension == Approx(damper_tension).epsilon(1e-12));

    Mat3 within = Mat3::Zero();
    for (std::uint32_t i = 0; i < fine.node_count(); ++i) {
      const Vec3 r = fine.rest[i] - level.rest[groups.of[i]];
      within += fine.mass[i] * (r.squaredNorm() * Mat3::Identity() - r * r.transpose());
    }
    CHECK((after.inertia + within - before.inertia).norm() < 1e-11 * before.inertia.norm());

    CHECK(connected_components(level).count == connected_components(fine).count);
    CHECK(std::accumulate(level.contact_area.begin(), level.contact_area.end(), 0.0) ==
          Approx(std::accumulate(fine.contact_area.begin(), fine.contact_area.end(), 0.0)));
  }
}

TEST_CASE("Nodes and springs that were not merged are copied bit for bit") {
  const MassSpringModel fine = random_model(3);
  const MassSpringModel level = merge_sets(fine, {{0, 1}});
  for (std::uint32_t i = 2; i < fine.node_count(); ++i) {
    REQUIRE(level.rest[i - 1] == fine.rest[i]);
    REQUIRE(level.mass[i - 1] == fine.mass[i]);
  }
  std::uint32_t kept = 0;
  for (std::uint32_t s = 0; s < level.spring_count(); ++s) {
    if (level.a[s] == 0) continue;
    for (std::uint32_t t = 0; t < fine.spring_count(); ++t)
      if (fine.a[t] == level.a[s] + 1 && fine.b[t] == level.b[s] + 1) {
        REQUIRE(level.stiffness[s] == fine.stiffness[t]);
        REQUIRE(level.rest_length[s] == fine.rest_length[t]);
        ++kept;
      }
  }
  CHECK(kept > 0);
}

TEST_CASE("A strong border keeps its nodes bit for bit") {
  const MassSpringModel fine = random_model(5, 6);
  const Groups groups = group_nodes(fine, {.border = BorderRule::strong, .seed = 5});
  const MassSpringModel level = merge(fine, groups);
  REQUIRE(level.node_count() < fine.node_count());
  for (std::uint32_t i = 0; i < fine.node_count(); ++i)
    if (fine.border[i] != 0) {
      REQUIRE(level.rest[groups.of[i]] == fine.rest[i]);
      REQUIRE(level.mass[groups.of[i]] == fine.mass[i]);
    }
}

TEST_CASE("Merging by invalid groups is an error") {
  const MassSpringModel fine = random_model(1);
  CHECK_THROWS_AS(merge(fine, identity_groups(3)), InputError);
  CHECK_THROWS_AS(groups_from_sets(fine, {{0, 1}, {1, 2}}), InputError);
  CHECK_THROWS_AS(groups_from_sets(fine, {{0, 100000}}), InputError);
  CHECK_THROWS_WITH(groups_from_sets(fine, {{0, 124}}), Catch::Contains("not connected"));
}
