#include "lod/grouping/graded_shares.hpp"

#include <algorithm>
#include <numeric>

#include <catch2/catch.hpp>

#include "base/error.hpp"
#include "lod/grouping/compact_groups.hpp"
#include "tests/support/bodies.hpp"

using namespace springlod;
using namespace springlod::lod;

TEST_CASE("Ungraded shares are proportional to the numbers of nodes") {
  CHECK(graded_shares({{300, 1}, {100, 1e6}}, 100, 0) == std::vector<std::uint32_t>{75, 25});
}

TEST_CASE("Graded shares give the stiff kind fewer groups, within bounds") {
  // 4^(-3/2) = 1/8 of the groups for each node would equalize the highest frequencies; the least
  // share is half the proportional one.
  CHECK(graded_shares({{1000, 1}, {1000, 4}}, 400, 1) == std::vector<std::uint32_t>{300, 100});
  // Grading 1/2 gives the ratio 1.1^(-3/4).
  const std::vector<std::uint32_t> mild = graded_shares({{1000, 1}, {1000, 1.1}}, 400, 0.5);
  CHECK(mild[0] + mild[1] == 400);
  CHECK(mild[1] == 193);
}

TEST_CASE("Grading leaves a small stiff kind enough groups to resolve its shape") {
  CHECK(graded_shares({{900, 1}, {60, 100}}, 480, 1) == std::vector<std::uint32_t>{456, 24});
  // That never exceeds its proportional share.
  CHECK(graded_shares({{900, 1}, {60, 100}}, 192, 1) == std::vector<std::uint32_t>{180, 12});
}

TEST_CASE("Graded shares add up to the count, with at least one group for each kind") {
  for (const double grading : {0.0, 0.3, 1.0})
    for (std::uint32_t count = 4; count <= 57; count += 7) {
      const std::vector<NodeKind> kinds{{40, 1}, {10, 50}, {6, 1e-3}, {1, 0}};
      const std::vector<std::uint32_t> shares = graded_shares(kinds, count, grading);
      CHECK(std::accumulate(shares.begin(), shares.end(), 0U) == count);
      for (std::size_t k = 0; k < kinds.size(); ++k) {
        CHECK(shares[k] >= 1);
        CHECK(shares[k] <= kinds[k].nodes);
      }
    }
}

TEST_CASE("The error for impossible shares names the possible range") {
  CHECK_THROWS_AS(graded_shares({{5, 1}, {5, 1}}, 1, 0), InputError);
  CHECK_THROWS_WITH(graded_shares({{5, 1}, {5, 1}}, 11, 0), Catch::Contains("use 2 to 10"));
  CHECK_THROWS_AS(graded_shares({{5, 1}, {5, 1}}, 4, 1.5), InputError);
}

TEST_CASE("Grading leaves the rubber a larger fraction of its nodes than the stiff rods") {
  const MassSpringModel base = springlod::test::rods();
  const auto groups_of = [&](double grading, std::uint32_t material) {
    const Groups groups = compact_groups(base, {.count = 120, .grading = grading});
    std::vector<bool> has(groups.count, false);
    for (std::uint32_t i = 0; i < base.node_count(); ++i)
      if (base.material[i] == material) has[groups.of[i]] = true;
    return std::count(has.begin(), has.end(), true);
  };
  const std::uint32_t stiff = base.material[0];
  CHECK(groups_of(0.5, stiff) < groups_of(0, stiff));
}
