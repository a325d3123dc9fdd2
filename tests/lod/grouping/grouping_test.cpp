#include "lod/grouping/grouping.hpp"

#include <cmath>
#include <limits>

#include <catch2/catch.hpp>

#include "lod/build.hpp"
#include "lod/merging/merge.hpp"
#include "tests/support/bodies.hpp"
#include "tests/support/models.hpp"

using namespace springlod;
using namespace springlod::lod;
using springlod::test::ball;
using springlod::test::block;
using springlod::test::random_model;
using springlod::test::rods;

namespace {

// Mean node count of each level over `seeds` chains without guards, as in the paper.
std::vector<double> mean_counts(const MassSpringModel& base, GroupingOptions grouping,
                                std::uint32_t levels, std::uint64_t seeds = 20) {
  std::vector<double> counts(levels + 1, 0);
  for (std::uint64_t seed = 1; seed <= seeds; ++seed) {
    grouping.seed = seed;
    const LodChain chain =
        simplify(base, {.levels = levels, .grouping = grouping, .guards = false});
    for (std::uint32_t n = 0; n <= levels; ++n) counts[n] += chain.levels[n].model.node_count();
  }
  for (double& count : counts) count /= static_cast<double>(seeds);
  return counts;
}

}  // namespace

TEST_CASE("Standard grouping reproduces the paper's cube: 216, 95, 41, 18") {
  const std::vector<double> counts = mean_counts(block(6, 6, 6), {}, 3);
  CHECK(counts[0] == 216);
  CHECK(std::abs(counts[1] - 95) < 6);
  CHECK(std::abs(counts[2] - 41) < 3);
  CHECK(std::abs(counts[3] - 18) < 2);
}

TEST_CASE("A strong border reproduces the paper's cube: 216, 180, 164, 158") {
  const std::vector<double> counts = mean_counts(block(6, 6, 6), {.border = BorderRule::strong}, 3);
  CHECK(std::abs(counts[1] - 180) < 2);
  CHECK(std::abs(counts[2] - 164) < 2);
  CHECK(std::abs(counts[3] - 158) < 2);
}

TEST_CASE("The sphere simplifies to about the paper's 123 and 55 nodes, weak border 121 and 53") {
  const std::vector<double> standard = mean_counts(ball(), {}, 2);
  CHECK(standard[0] == 281);
  CHECK(std::abs(standard[1] - 123) < 8);
  CHECK(std::abs(standard[2] - 55) < 5);
  const std::vector<double> weak = mean_counts(ball(), {.border = BorderRule::weak}, 1);
  CHECK(weak[1] > 110);
  CHECK(weak[1] < 132);
}

TEST_CASE("Groups have at most three nodes, all joined to the first") {
  const MassSpringModel m = random_model(2);
  for (const Grouping grouping :
       {Grouping::standard, Grouping::priority_soft, Grouping::priority_hard}) {
    const Groups groups = group_nodes(m, {.grouping = grouping, .seed = 7});
    REQUIRE_NOTHROW(validate(groups));
    std::vector<std::vector<std::uint32_t>> members(groups.count);
    for (std::uint32_t i = 0; i < m.node_count(); ++i) members[groups.of[i]].push_back(i);
    std::vector<std::uint32_t> sizes(4, 0);
    for (const auto& group : members) {
      REQUIRE(group.size() <= 3);
      ++sizes[group.size()];
      REQUIRE_NOTHROW(groups_from_sets(m, {group}));
    }
    CHECK(sizes[2] > 0);
    CHECK(sizes[3] > 0);
  }
}

TEST_CASE("The same seed gives the same groups, another seed others") {
  const MassSpringModel m = block(6, 6, 6);
  const Groups one = group_nodes(m, {.seed = 1});
  CHECK(one.of == group_nodes(m, {.seed = 1}).of);
  CHECK(one.of != group_nodes(m, {.seed = 2}).of);
}

TEST_CASE("Scaling every stiffness changes no group") {
  for (const MassSpringModel& m : {rods(), random_model(4)}) {
    MassSpringModel scaled = m;
    for (double& k : scaled.stiffness) k *= 3.7e5;
    for (const Grouping grouping :
         {Grouping::standard, Grouping::priority_soft, Grouping::priority_hard})
      CHECK(group_nodes(m, {.grouping = grouping}).of ==
            group_nodes(scaled, {.grouping = grouping}).of);
  }
}

TEST_CASE("Moving or resizing a lattice changes no group") {
  const MassSpringModel m = block(5, 5, 5);
  MassSpringModel moved = m;
  for (Vec3& x : moved.rest) x = 0.37 * x + Vec3(0.1, -7.3, 1e3);
  for (std::uint32_t s = 0; s < moved.spring_count(); ++s)
    moved.rest_length[s] = (moved.rest[moved.b[s]] - moved.rest[moved.a[s]]).norm();
  CHECK(group_nodes(m, {}).of == group_nodes(moved, {}).of);
}

TEST_CASE("Under a weak border no group mixes border and inner nodes") {
  const MassSpringModel m = ball();
  for (const Grouping grouping : {Grouping::standard, Grouping::priority_soft}) {
    const Groups groups =
        group_nodes(m, {.grouping = grouping, .border = BorderRule::weak, .seed = 3});
    std::vector<int> kind(groups.count, -1);
    for (std::uint32_t i = 0; i < m.node_count(); ++i) {
      int& k = kind[groups.of[i]];
      if (k >= 0) REQUIRE(k == m.border[i]);
      k = m.border[i];
    }
  }
}

TEST_CASE("Priority grouping mixes materials less often than standard grouping") {
  const MassSpringModel m = rods();
  const auto mixed = [&](Grouping grouping) {
    std::uint32_t count = 0;
    for (std::uint64_t seed = 1; seed <= 10; ++seed) {
      const Groups groups = group_nodes(m, {.grouping = grouping, .seed = seed});
      std::vector<int> kind(groups.count, -1);
      for (std::uint32_t i = 0; i < m.node_count(); ++i) {
        int& k = kind[groups.of[i]];
        if (k >= 0 && k != static_cast<int>(m.material[i])) ++count;
        k = static_cast<int>(m.material[i]);
      }
    }
    return count;
  };
  const std::uint32_t standard = mixed(Grouping::standard);
  CHECK(mixed(Grouping::priority_soft) < standard);
  CHECK(mixed(Grouping::priority_hard) < standard);
}

TEST_CASE("The node priority sets the order of visits, the pair cost the partner") {
  // On a chain the first visited node takes a neighbour, which determines all other pairs.
  const MassSpringModel chain = springlod::test::table_model({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}},
                                                             {1, 1, 1}, {{0, 1, 1}, {1, 2, 1}});
  GroupingOptions options;
  options.pair_cost = [](std::uint32_t a, std::uint32_t) { return a == 0 ? 2.0 : 1.0; };
  options.node_priority = [](std::uint32_t node) { return node == 1 ? 0.0 : 1.0; };
  for (std::uint64_t seed = 1; seed <= 8; ++seed) {
    options.seed = seed;
    const Groups groups = group_nodes(chain, options);
    CHECK(groups.of[1] == groups.of[2]);
  }
  options.pair_cost = [](std::uint32_t, std::uint32_t) {
    return std::numeric_limits<double>::infinity();
  };
  CHECK(group_nodes(chain, options).count == 3);
}
