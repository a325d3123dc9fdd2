#include "model/spring_rows.hpp"

#include <catch2/catch.hpp>

#include "tests/support/models.hpp"

using namespace springlod;

TEST_CASE("Spring rows tell the springs of a node as the adjacency does") {
  MassSpringModel lone = test::table_model({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {3, 0, 0}},
                                           {1, 1, 1, 1}, {{0, 3, 1}, {1, 3, 1}});
  for (const MassSpringModel& model : {test::random_model(4), lone}) {
    const Adjacency adj = adjacency(model);
    const SpringRows rows(model);
    for (std::uint32_t i = 0; i < model.node_count(); ++i) {
      REQUIRE(rows.count(i) == adj.start[i + 1] - adj.start[i]);
      std::uint32_t e = adj.start[i];
      rows.for_each(i, [&](std::uint32_t neighbour, std::uint32_t spring) {
        REQUIRE(neighbour == adj.neighbour[e]);
        REQUIRE(spring == adj.spring[e]);
        ++e;
      });
      REQUIRE(e == adj.start[i + 1]);
    }
  }
}
