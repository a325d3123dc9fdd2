#include <cstdint>
#include <string>
#include <variant>

#include <catch2/catch.hpp>

#include "report/tables.hpp"
#include "tests/support/models.hpp"

using namespace springlod;
using namespace springlod::report;

namespace {

// Two levels of a 3-4-0 triangle (diagonal 5 m), two starts each.
LodChain two_levels() {
  LodChain chain;
  for (const double stiffness : {2.0, 1.0}) {
    Level level;
    level.model = test::table_model({{0, 0, 0}, {3, 0, 0}, {0, 4, 0}}, {1, 1, 1},
                                    {{0, 1, stiffness}, {0, 2, stiffness}, {1, 2, stiffness}});
    chain.levels.push_back(level);
  }
  return chain;
}

sim::Comparison comparison() {
  sim::Comparison c;
  for (std::uint32_t level = 0; level < 2; ++level) {
    sim::LevelRuns runs;
    runs.label = level == 0 ? "base" : "level 1";
    runs.level = level;
    runs.first.step = 1e-4;
    runs.first.undamped_step = level == 0 ? 1e-3 : 2e-4;
    runs.first.limited_by = level == 0 ? sim::StepBound::damping : sim::StepBound::springs;
    for (const double distance : {1.0, 3.0}) {
      sim::StartResult start;
      start.distance = distance;
      start.surface_error = level * 0.05 * distance;
      start.shape_error = level * 0.5;
      start.simulated = 2;
      start.spring_updates = level == 0 ? 1000 : 250;
      start.wall_seconds = 0.5;
      start.ledger_error = level * 1e-3 * distance;
      runs.starts.push_back(start);
    }
    c.levels.push_back(runs);
  }
  return c;
}

const Cell& cell_of(const Table& table, std::size_t row, const std::string& column) {
  const auto at = std::find(table.columns.begin(), table.columns.end(), column);
  if (at == table.columns.end()) FAIL("no column " + column);
  return table.rows.at(row).at(static_cast<std::size_t>(at - table.columns.begin()));
}

double number(const Table& table, std::size_t row, const std::string& column) {
  const Cell& cell = cell_of(table, row, column);
  const auto* whole_number = std::get_if<std::int64_t>(&cell);
  return whole_number != nullptr ? static_cast<double>(*whole_number) : std::get<double>(cell);
}

std::string text(const Table& table, std::size_t row, const std::string& column) {
  return std::get<std::string>(cell_of(table, row, column));
}

}  // namespace

TEST_CASE("the row of a level has means over its starts and the cost relative to the base") {
  const Table table = comparison_table(comparison(), two_levels());
  REQUIRE(table.rows.size() == 2);
  CHECK(number(table, 0, "nodes") == 3);
  CHECK(number(table, 0, "ends") == 6);
  CHECK(number(table, 0, "step") == 1e-4);
  CHECK(number(table, 1, "undamped_step") == 2e-4);
  CHECK(text(table, 0, "limited_by") == "damping");
  CHECK(text(table, 1, "limited_by") == "springs");
  CHECK(number(table, 0, "spring_updates_per_second") == 500);
  CHECK(number(table, 0, "cost_ratio") == 1);
  CHECK(number(table, 1, "cost_ratio") == 4);
  CHECK(number(table, 1, "surface_error") == Approx(0.1));
  CHECK(number(table, 1, "surface_error_percent") == Approx(2));
  CHECK(number(table, 1, "shape_error_percent") == Approx(10));
  CHECK(number(table, 1, "distance") == 2);
  CHECK(number(table, 1, "distance_spread") == Approx(std::sqrt(2)));
  CHECK(number(table, 1, "ledger_error") == Approx(3e-3));  // the largest, not the mean
}

TEST_CASE("measured times are in a separate table") {
  const Table starts = starts_table(comparison());
  REQUIRE(starts.rows.size() == 4);
  CHECK(number(starts, 3, "start") == 2);
  CHECK(number(starts, 3, "distance") == 3);
  for (const Table& table : {starts, comparison_table(comparison(), two_levels())})
    for (const std::string& column : table.columns) CHECK(column.find("wall") == std::string::npos);
  const Table timings = timings_table(comparison());
  REQUIRE(timings.rows.size() == 4);
  CHECK(number(timings, 0, "spring_updates_per_wall_second") == 2000);
  CHECK(number(timings, 0, "real_time_factor") == 4);
}
