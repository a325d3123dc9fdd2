#include "report/pick_text.hpp"

#include <limits>

#include <catch2/catch.hpp>

using namespace springlod;
using namespace springlod::report;
using Catch::Contains;

namespace {

sim::Pick make_pick(const sim::PickOptions& options) {
  sim::Pick pick;
  pick.options = options;
  pick.levels = {
      {.level = 0, .nodes = 1000, .springs = 8000, .error = 0, .cost = 2.9e-3},
      {.level = 1, .nodes = 450, .springs = 4000, .error = 0.0062, .cost = 0.8e-3},
      {.level = 2, .nodes = 180, .springs = 1500, .error = 0.0141, .cost = 0.207e-3},
      {.level = 3, .nodes = 90, .springs = 700, .error = 0.031, .cost = 0.09e-3},
  };
  pick.level = sim::choose_level(pick.levels, options);
  return pick;
}

}  // namespace

TEST_CASE("A pick by error states error, gain and what the next level would be") {
  CHECK(pick_text(make_pick({.error = 0.02})) ==
        "Level 2 (18 % of the nodes) stays within 2 %: predicted error 1.4 %, 14 times cheaper "
        "than the base (210 us instead of 2.9 ms a frame). Level 3 would be 32 times cheaper than "
        "the base (90 us instead of 2.9 ms a frame), with a predicted error of 3.1 %.");
  CHECK_THAT(pick_text(make_pick({.error = 0.05, .measure = true})),
             Contains("measured error 3.1 %") && Contains("It is the coarsest level."));
  CHECK_THAT(pick_text(make_pick({.error = 0.001})),
             Contains("Only the base (1000 nodes, 2.9 ms a frame) stays within 0.1 %. Level 1"));
}

TEST_CASE("A pick by cost states the cost, and what the next finer level would be") {
  CHECK_THAT(pick_text(make_pick({.budget = 0.5e-3})),
             Contains("Level 2 (18 % of the nodes) is the most accurate within 500 us a frame") &&
                 Contains("Level 1 would be 3.6 times cheaper"));
  CHECK_THAT(pick_text(make_pick({.budget = 5e-3})), Contains("No coarser level is needed"));
  CHECK_THAT(pick_text(make_pick({.budget = 1e-6})),
             Contains("No level stays within 1 us a frame. The cheapest is level 3: 90 us"));
}

TEST_CASE("The table of a pick has a row for each level, without an error that is unknown") {
  sim::Pick pick = make_pick({.error = 0.02});
  pick.levels[3].error = std::numeric_limits<double>::infinity();
  const Table table = pick_table(pick);
  REQUIRE(table.rows.size() == 4);
  CHECK(std::get<double>(table.rows[2][6]) == Approx(1.41));
  CHECK(std::holds_alternative<std::monostate>(table.rows[3][5]));
  CHECK(std::get<std::int64_t>(table.rows[1][7]) == 1);
  for (const auto& row : table.rows) CHECK(row.size() == table.columns.size());
}
