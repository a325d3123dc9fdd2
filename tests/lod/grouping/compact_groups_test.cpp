#include "lod/grouping/compact_groups.hpp"

#include <algorithm>
#include <set>
#include <string>

#include <catch2/catch.hpp>

#include "base/disjoint_sets.hpp"
#include "base/error.hpp"
#include "lod/grouping/connected_groups.hpp"
#include "lod/grouping/exact_count.hpp"
#include "lod/grouping/metis_groups.hpp"
#include "lod/merging/relink.hpp"
#include "tests/support/bodies.hpp"
#include "tests/support/models.hpp"

using namespace springlod;
using namespace springlod::lod;
using springlod::test::ball;
using springlod::test::block;
using springlod::test::random_model;
using springlod::test::rods;

namespace {

/// Number of groups that their own springs do not connect.
std::uint32_t torn_groups(const MassSpringModel& model, const Groups& groups) {
  DisjointSets joined(model.node_count());
  std::uint32_t pieces = model.node_count();
  for (std::uint32_t s = 0; s < model.spring_count(); ++s)
    if (groups.of[model.a[s]] == groups.of[model.b[s]] && joined.unite(model.a[s], model.b[s]))
      --pieces;
  return pieces - groups.count;
}

}  // namespace

TEST_CASE("Compact groups are of the requested number, of similar size and connected") {
  for (const MassSpringModel& base : {ball(), rods(), block(6, 5, 4), random_model(3)})
    for (const std::uint32_t count : {20U, base.node_count() / 2, base.node_count()}) {
      const Groups groups = compact_groups(base, {.count = count});
      validate(groups);
      CHECK(groups.count == count);
      CHECK(torn_groups(base, groups) == 0);
      std::vector<std::uint32_t> size(count, 0);
      for (const std::uint32_t g : groups.of) ++size[g];
      CHECK(*std::max_element(size.begin(), size.end()) <= 3 * base.node_count() / count + 2);
    }
}

TEST_CASE("Compact groups are reproducible and depend on the seed") {
  const MassSpringModel base = rods();
  const Groups first = compact_groups(base, {.count = 100, .seed = 5});
  CHECK(first.of == compact_groups(base, {.count = 100, .seed = 5}).of);
  CHECK(first.of != compact_groups(base, {.count = 100, .seed = 6}).of);
}

TEST_CASE("Compact groups of a model with few inner nodes, or none") {
  MassSpringModel base = block(3, 3, 3);
  base.border.assign(base.node_count(), 1);
  const CompactOptions single{.count = base.node_count(), .border = BorderRule::strong};
  CHECK(compact_groups(base, single).count == base.node_count());
  base.border[0] = 0;
  for (const BorderRule border : {BorderRule::weak, BorderRule::strong}) {
    const Groups groups = compact_groups(base, {.count = base.node_count(), .border = border});
    validate(groups);
    CHECK(groups.count == base.node_count());
  }
  CHECK_THROWS_WITH(compact_groups(base, {.count = 2, .border = BorderRule::strong}),
                    Catch::Contains("use " + std::to_string(base.node_count()) + " to "));
}

TEST_CASE("Compact groups of stiff rods and a soft joint do not cross the joint") {
  const MassSpringModel base = rods();
  const Groups groups = compact_groups(base, {.count = 120});
  std::vector<std::set<std::uint32_t>> materials(groups.count);
  for (std::uint32_t i = 0; i < base.node_count(); ++i)
    materials[groups.of[i]].insert(base.material[i]);
  for (const auto& of_group : materials) CHECK(of_group.size() == 1);
}

TEST_CASE("Compact groups follow the border rules") {
  const MassSpringModel base = block(6, 6, 6);
  const auto mixed = [&](const Groups& groups) {
    std::vector<std::set<std::uint8_t>> kinds(groups.count);
    for (std::uint32_t i = 0; i < base.node_count(); ++i)
      kinds[groups.of[i]].insert(base.border[i]);
    return std::count_if(kinds.begin(), kinds.end(), [](const auto& k) { return k.size() > 1; });
  };
  CHECK(mixed(compact_groups(base, {.count = 80})) > 0);
  CHECK(mixed(compact_groups(base, {.count = 80, .border = BorderRule::weak})) == 0);
  const Groups strong = compact_groups(base, {.count = 180, .border = BorderRule::strong});
  CHECK(strong.count == 180);
  std::vector<std::uint32_t> size(strong.count, 0);
  for (const std::uint32_t g : strong.of) ++size[g];
  for (std::uint32_t i = 0; i < base.node_count(); ++i)
    if (base.border[i] != 0) CHECK(size[strong.of[i]] == 1);
  CHECK_THROWS_AS(compact_groups(base, {.count = 100, .border = BorderRule::strong}), InputError);
}

TEST_CASE("More compact groups than nodes, or fewer than materials, are an error") {
  CHECK_THROWS_WITH(compact_groups(rods(), {.count = 1}), Catch::Contains("2 to 368"));
  CHECK_THROWS_AS(compact_groups(rods(), {.count = 369}), InputError);
}

#ifdef SPRINGLOD_HAS_METIS
TEST_CASE("METIS groups are of the requested number and connected") {
  for (const MassSpringModel& base : {ball(), rods(), block(6, 5, 4)})
    for (const std::uint32_t count : {1U, 30U, base.node_count() / 2}) {
      const Groups groups = metis_groups(base, count, 1);
      validate(groups);
      CHECK(groups.count == count);
      CHECK(torn_groups(base, groups) == 0);
    }
  CHECK(metis_groups(ball(), 50, 2).of == metis_groups(ball(), 50, 2).of);
  CHECK_THROWS_AS(metis_groups(ball(), 0, 1), InputError);
}
#else
TEST_CASE("A build without METIS says so when its groups are asked for") {
  CHECK_THROWS_AS(metis_groups(ball(), 50, 1), InputError);
  CHECK_THROWS_WITH(metis_groups(ball(), 50, 1),
                    Catch::Contains("without METIS") && Catch::Contains("libmetis-dev"));
}
#endif

TEST_CASE("The smaller fragment of a disconnected group joins a neighbouring group") {
  const MassSpringModel rope =
      test::table_model({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {3, 0, 0}}, {1, 1, 1, 1},
                        {{0, 1, 100}, {1, 2, 100}, {2, 3, 100}});
  Groups groups{{0, 0, 1, 0}, 2};
  connect_groups(rope, groups);
  CHECK(groups.of == std::vector<std::uint32_t>{0, 0, 1, 1});
}

TEST_CASE("split_to_count takes nodes out of the largest groups, which stay connected") {
  const MassSpringModel base = block(4, 4, 4);
  Groups groups{std::vector<std::uint32_t>(64, 0), 1};
  for (std::uint32_t i = 32; i < 64; ++i) groups.of[i] = 1;
  groups.count = 2;
  split_to_count(base, SpringRows(base), 40, groups);
  validate(groups);
  CHECK(groups.count == 40);
  CHECK(torn_groups(base, groups) == 0);
  CHECK_THROWS_AS(split_to_count(base, SpringRows(base), 65, groups), InputError);
}
