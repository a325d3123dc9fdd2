#include "lod/relink.hpp"

#include <algorithm>
#include <map>
#include <utility>

#include <catch2/catch.hpp>

#include "lod/grouping.hpp"
#include "tests/support/models.hpp"

using namespace springlod;

TEST_CASE("Relinking tells every joined pair of groups once and where each spring goes") {
  for (const std::uint64_t seed : {1U, 2U, 3U}) {
    const MassSpringModel fine = test::random_model(seed);
    const Groups groups = group_nodes(fine, {.seed = seed});
    const Relinking links = relink(fine.a, fine.b, groups);

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

TEST_CASE("Relinking copes with no springs and with one group for all") {
  const Relinking none = relink({}, {}, identity_groups(3));
  CHECK(none.a.empty());
  CHECK(none.into.empty());
  const Relinking one = relink({0, 1}, {1, 2}, {{0, 0, 0}, 1});
  CHECK(one.a.empty());
  CHECK(one.into == std::vector<std::uint32_t>(2, Relinking::kInside));
}
