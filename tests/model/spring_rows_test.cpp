#include "model/spring_rows.hpp"

#include <algorithm>
#include <vector>

#include <catch2/catch.hpp>

#include "tests/support/models.hpp"

using namespace springlod;

TEST_CASE("Spring rows list the springs of a node as the adjacency does") {
  const MassSpringModel lone = test::table_model({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {3, 0, 0}},
                                                 {1, 1, 1, 1}, {{0, 3, 1}, {1, 3, 1}});
  for (const MassSpringModel& model : {test::random_model(4), lone}) {
    const SpringRows rows(model);
    std::vector<int> seen(model.spring_count(), 0);
    for (std::uint32_t i = 0; i < model.node_count(); ++i) {
      std::vector<std::uint32_t> neighbours;
      rows.for_each(i, [&](std::uint32_t j, std::uint32_t s) {
        if (!neighbours.empty()) REQUIRE(neighbours.back() < j);
        neighbours.push_back(j);
        ++seen[s];
        REQUIRE((model.a[s] == std::min(i, j) && model.b[s] == std::max(i, j)));
      });
      REQUIRE(rows.count(i) == neighbours.size());
      for (std::uint32_t j = 0; j < model.node_count(); ++j)
        REQUIRE(rows.joined(i, j) == std::binary_search(neighbours.begin(), neighbours.end(), j));
    }
    for (const int times : seen) REQUIRE(times == 2);
  }
}
