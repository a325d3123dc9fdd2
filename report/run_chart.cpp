#include "report/run_chart.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "base/error.hpp"

namespace springlod::report {
namespace {

ChartPoint point_at(double x, double y) {
  ChartPoint point;
  point.x = x;
  point.y = y;
  return point;
}

std::vector<Vec3> centers_of(const LabelledRun& run) {
  std::vector<Vec3> centers;
  for (const sim::Frame& frame : run.trajectory.frames)
    centers.push_back(center_of_mass(run.model, frame.x));
  return centers;
}

/// `value` of each centre of mass, at the time of its frame.
template <class Value>
std::vector<ChartPoint> points_of_centers(const LabelledRun& run, Value value) {
  const std::vector<Vec3> centers = centers_of(run);
  std::vector<ChartPoint> points;
  for (std::size_t k = 0; k < centers.size(); ++k)
    points.push_back(point_at(run.trajectory.frames[k].time, value(centers, k)));
  return points;
}

std::vector<ChartPoint> heights(const LabelledRun& run) {
  return points_of_centers(
      run, [](const std::vector<Vec3>& centers, std::size_t k) { return centers[k].z(); });
}

std::vector<ChartPoint> distances(const LabelledRun& run) {
  return points_of_centers(run, [&](const std::vector<Vec3>& centers, std::size_t k) {
    return sim::measured_distance(run.scenario, centers.front(), centers[k]);
  });
}

/// Between two frames, at the middle of their times: frames have no velocities.
std::vector<ChartPoint> speeds(const LabelledRun& run) {
  const std::vector<sim::Frame>& frames = run.trajectory.frames;
  const std::vector<Vec3> centers = centers_of(run);
  std::vector<ChartPoint> points;
  for (std::size_t k = 1; k < centers.size(); ++k) {
    const double apart = frames[k].time - frames[k - 1].time;
    points.push_back(
        point_at(frames[k - 1].time + apart / 2, (centers[k] - centers[k - 1]).norm() / apart));
  }
  return points;
}

template <class Energy>
std::vector<ChartPoint> energies(const LabelledRun& run, Energy energy) {
  if (run.trajectory.ledger.empty())
    throw InputError(fmt::format(
        "chart: \"{}\" kept no energies; run it without ledger = false, or draw another quantity",
        run.label));
  std::vector<ChartPoint> points;
  for (const sim::LedgerEntry& entry : run.trajectory.ledger)
    points.push_back(point_at(entry.time, energy(entry)));
  return points;
}

std::vector<ChartPoint> kinetic_energies(const LabelledRun& run) {
  return energies(run, [](const sim::LedgerEntry& entry) { return entry.kinetic; });
}

std::vector<ChartPoint> elastic_energies(const LabelledRun& run) {
  return energies(run, [](const sim::LedgerEntry& entry) { return entry.elastic; });
}

std::vector<ChartPoint> mechanical_energies(const LabelledRun& run) {
  return energies(run, [](const sim::LedgerEntry& entry) { return entry.mechanical(); });
}

constexpr RunQuantityChoice kQuantities[] = {
    {{RunQuantity::height, "height", "z of the centre of mass"},
     "height of the centre of mass [m]",
     heights},
    {{RunQuantity::distance, "distance",
      "as the column distance of a comparison: of the centre of mass from the obstacle "
      "measure_from "
      "of the scenario, else from the start, horizontally"},
     "distance of the centre of mass [m]",
     distances},
    {{RunQuantity::speed, "speed", "of the centre of mass, mean between two frames"},
     "speed of the centre of mass [m/s]",
     speeds},
    {{RunQuantity::kinetic, "kinetic", "kinetic energy"}, "kinetic energy [J]", kinetic_energies},
    {{RunQuantity::elastic, "elastic", "energy of the springs"},
     "elastic energy [J]",
     elastic_energies},
    {{RunQuantity::mechanical, "mechanical",
      "energy that can still become motion: kinetic, elastic, of gravity, contacts and anchors"},
     "mechanical energy [J]",
     mechanical_energies}};

void require_motion(const LabelledRun& run) {
  constexpr std::size_t kLeastFrames = 3;  // the first and the last alone make a straight line
  if (run.trajectory.frames.size() >= kLeastFrames) return;
  throw InputError(
      fmt::format("chart: \"{}\" has {} frames, and a line over time needs {}; run it with a "
                  "greater frame_rate",
                  run.label, run.trajectory.frames.size(), kLeastFrames));
}

}  // namespace

ChoiceTable<RunQuantityChoice> choices(RunQuantity /*any*/) {
  return {"quantity", kQuantities};
}

std::vector<ChartSeries> run_series(const std::vector<LabelledRun>& runs, RunQuantity quantity) {
  std::vector<ChartSeries> series;
  for (const LabelledRun& run : runs) {
    require_motion(run);
    series.push_back({.name = run.label,
                      .points = choice_of(quantity).points(run),
                      // A line that lies on another is seen between its dashes.
                      .dashed = series.size() % 2 == 1,
                      .symbol = ChartSymbol::none});
  }
  return series;
}

ChartOptions run_chart(const std::vector<LabelledRun>& runs, RunQuantity quantity) {
  const bool shared = std::all_of(runs.begin(), runs.end(), [&](const LabelledRun& run) {
    return run.scenario.name == runs.front().scenario.name;
  });
  return {.title = shared && !runs.empty() ? runs.front().scenario.name : "",
          .x_label = "time [s]",
          .y_label = choice_of(quantity).axis};
}

}  // namespace springlod::report
