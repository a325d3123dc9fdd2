#include "report/run_chart.hpp"

#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include <catch2/catch.hpp>

#include "base/error.hpp"
#include "tests/render/bodies.hpp"

using namespace springlod;
using namespace springlod::report;
using namespace springlod::test;

namespace {

constexpr double kApart = 0.1;  // [s]

// A bar thrown at (3, 4, 5) m/s from a height of 2 m, in the frames of a run.
struct Throw {
  MassSpringModel model = bar();
  sim::Trajectory trajectory;
  sim::Scenario scenario;

  explicit Throw(int frames = 6) {
    const Vec3 center = center_of_mass(model, model.rest);
    for (int k = 0; k < frames; ++k) {
      const double t = kApart * k;
      const Vec3 place(3 * t, 4 * t, 2 + 5 * t - 4.905 * t * t);
      trajectory.frames.push_back({t, moved(model.rest, place - center)});
      sim::LedgerEntry& entry = trajectory.ledger.emplace_back();
      entry.time = t;
      entry.kinetic = 10 + k;
      entry.elastic = 1;
      entry.gravity = -5;
      entry.lost_damping = 100;
    }
    scenario.name = "throw";
    scenario.obstacles = {{sim::Plane{-Vec3::UnitX(), -7}, "wall"}};
  }
  LabelledRun as(const std::string& label) const { return {label, model, trajectory, scenario}; }
};

std::vector<ChartPoint> points_of(const Throw& run, RunQuantity quantity) {
  return run_series({run.as("a")}, quantity).at(0).points;
}

}  // namespace

TEST_CASE("a chart of runs has a line for each, over its own time") {
  const Throw whole;
  const Throw early(4);
  const auto series = run_series({whole.as("long"), early.as("short")}, RunQuantity::height);
  REQUIRE(series.size() == 2);
  CHECK(series[0].name == "long");
  CHECK(series[1].name == "short");
  CHECK(series[0].points.size() == 6);
  CHECK(series[1].points.size() == 4);
  CHECK(series[1].points.back().x == Approx(0.3));
  CHECK(series[0].symbol == ChartSymbol::none);
  CHECK(series[0].dashed != series[1].dashed);
}

TEST_CASE("quantities of runs have their values and units") {
  Throw run;
  const auto height = points_of(run, RunQuantity::height);
  CHECK(height[0].y == Approx(2));
  CHECK(height[5].x == Approx(0.5));
  CHECK(height[5].y == Approx(2 + 2.5 - 4.905 * 0.25));
  // From the start, horizontally; then from the wall at x = 7 m.
  CHECK(points_of(run, RunQuantity::distance)[5].y == Approx(2.5));
  run.scenario.measure_from = "wall";
  CHECK(points_of(run, RunQuantity::distance)[5].y == Approx(5.5));
  const auto speed = points_of(run, RunQuantity::speed);
  REQUIRE(speed.size() == 5);
  CHECK(speed[1].x == Approx(0.15));
  const double upwards = 5 - 9.81 * 0.15;  // in the middle, as the mean of a parabola
  CHECK(speed[1].y == Approx(std::sqrt(25 + upwards * upwards)));
  CHECK(points_of(run, RunQuantity::kinetic)[5].y == 15);
  CHECK(points_of(run, RunQuantity::elastic)[5].y == 1);
  CHECK(points_of(run, RunQuantity::mechanical)[5].y == 11);  // without what is lost

  for (const auto& [quantity, unit] :
       std::vector<std::pair<RunQuantity, std::string>>{{RunQuantity::height, "[m]"},
                                                        {RunQuantity::distance, "[m]"},
                                                        {RunQuantity::speed, "[m/s]"},
                                                        {RunQuantity::kinetic, "[J]"},
                                                        {RunQuantity::elastic, "[J]"},
                                                        {RunQuantity::mechanical, "[J]"}}) {
    const ChartOptions chart = run_chart({run.as("a")}, quantity);
    CHECK_THAT(chart.y_label, Catch::EndsWith(unit));
    CHECK(chart.x_label == "time [s]");
  }
}

TEST_CASE("the title of a chart of runs is the scenario that they share") {
  const Throw run;
  Throw other;
  CHECK(run_chart({run.as("a"), other.as("b")}, RunQuantity::height).title == "throw");
  other.scenario.name = "roll";
  CHECK(run_chart({run.as("a"), other.as("b")}, RunQuantity::height).title.empty());
}

TEST_CASE("a run with too few frames or without energies is named") {
  const Throw whole;
  const Throw few(2);
  CHECK_THROWS_WITH(run_series({whole.as("a"), few.as("b")}, RunQuantity::height),
                    Catch::Contains("\"b\" has 2 frames") && Catch::Contains("greater frame_rate"));
  Throw bare;
  bare.trajectory.ledger.clear();
  CHECK_THROWS_WITH(run_series({bare.as("c")}, RunQuantity::kinetic),
                    Catch::Contains("\"c\" kept no energies") && Catch::Contains("ledger"));
  CHECK(run_series({bare.as("c")}, RunQuantity::height).size() == 1);
}
