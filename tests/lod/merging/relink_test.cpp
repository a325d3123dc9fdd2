#include "lod/merging/relink.hpp"

#include <algorithm>
#include <map>
#include <utility>

#include <catch2/catch.hpp>

#include "lod/grouping/grouping.hpp"
#include "tests/support/models.hpp"

using namespace springlod;
using namespace springlod::lod;

TEST_CASE("Relinking lists every joined pair of groups once and maps each spring to its pair") {
  for (const std::uint64_t seed : {1U, 2U, 3U}) {
    const MassSpringModel fine = test::random_model(seed);
    const Groups groups = group_nodes(fine, {.seed = seed});
    const Relinking links = relink(SpringRows(fine), groups);

    std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> pairs;
    for (std::uint32_t s = 0; s < fine.spring_count(); ++s)
      if (groups.of[fine.a[s]] != groups.of[fine.b[s]])
        pairs.try_emplace(std::minmax(groups.of[fine.a[s]], groups.of[fine.b[s]]), 0);
    std::uint32_t number = 0;
    for (auto& [pair, at] : pairs) at = number++;

    REQUIRE(links.a.size() == pairs.size());
    REQUIRE(links.b.size() == pairs.size());
    for (const auto& [pair, at] : pairs) {
      REQUIRE(links.a[at] == pair.first);
      REQUIRE(links.b[at] == pair.second);
    }
    REQUIRE(links.into.size() == fine.spring_count());
    for (std::uint32_t s = 0; s < fine.spring_count(); ++s) {
      const auto found = pairs.find(std::minmax(groups.of[fine.a[s]], groups.of[fine.b[s]]));
      REQUIRE(links.into[s] == (found == pairs.end() ? Relinking::kInside : found->second));
    }
  }
}

TEST_CASE("Relinking twice equals relinking by the composed groups") {
  const MassSpringModel fine = test::random_model(8);
  const Groups first = group_nodes(fine, {.seed = 8});
  Groups second{std::vector<std::uint32_t>(first.count), (first.count + 1) / 2};
  for (std::uint32_t g = 0; g < first.count; ++g) second.of[g] = g / 2;
  Relinking once = relink(SpringRows(fine), first);
  Relinking again = relink(SpringRows(first.count, once.a, once.b), second);
  const Relinking both = compose(std::move(once), std::move(again));
  const Relinking direct = relink(SpringRows(fine), compose(first, second));
  CHECK(both.a == direct.a);
  CHECK(both.b == direct.b);
  CHECK(both.into == direct.into);
}

TEST_CASE("Relinking works without springs and with one group for all nodes") {
  const std::vector<std::uint32_t> nothing;
  const Relinking none = relink(SpringRows(3, nothing, nothing), identity_groups(3));
  CHECK(none.a.empty());
  CHECK(none.into.empty());
  const std::vector<std::uint32_t> a{0, 1};
  const std::vector<std::uint32_t> b{1, 2};
  const Relinking one = relink(SpringRows(3, a, b), {{0, 0, 0}, 1});
  CHECK(one.a.empty());
  CHECK(one.into == std::vector<std::uint32_t>(2, Relinking::kInside));
}
