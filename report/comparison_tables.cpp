#include <algorithm>
#include <vector>

#include "report/stats.hpp"
#include "report/tables.hpp"

namespace springlod::report {

namespace {

template <class Get>
double mean_over(const sim::LevelRuns& runs, Get get) {
  double sum = 0;
  for (const sim::StartResult& start : runs.starts) sum += static_cast<double>(get(start));
  return runs.starts.empty() ? 0 : sum / static_cast<double>(runs.starts.size());
}

double distance_spread(const sim::LevelRuns& runs) {
  if (runs.starts.size() < 2) return 0;
  std::vector<double> distances;
  for (const sim::StartResult& start : runs.starts) distances.push_back(start.distance);
  return standard_deviation(distances);
}

double largest_ledger_error(const sim::LevelRuns& runs) {
  double largest = 0;
  for (const sim::StartResult& start : runs.starts) largest = std::max(largest, start.ledger_error);
  return largest;
}

double cost_per_second(const sim::LevelRuns& runs) {
  return mean_over(runs, [](const sim::StartResult& s) {
    return s.simulated > 0 ? static_cast<double>(s.spring_updates) / s.simulated : 0;
  });
}

double base_diagonal(const LodChain& chain) {
  return bounds(chain.levels.front().model.rest).diagonal().norm();
}

}  // namespace

std::string comparison_columns_help() {
  return "level, label, nodes, springs, ends, step [s], undamped_step (stable step without "
         "damping) "
         "[s], limited_by (what determines the step, see Trajectory), spring_updates_per_second "
         "(of simulated "
         "time), cost_ratio (base / level), surface_error [m], surface_error_percent and "
         "shape_error_percent (of the base's bounding diagonal), shape_error [m], distance [m], "
         "distance_spread [m] (standard deviation over the starts), energy_difference (largest, of "
         "the base's largest kinetic energy), simulated [s], ledger_error (of the largest kinetic "
         "energy)";
}

Table comparison_table(const sim::Comparison& comparison, const LodChain& chain) {
  Table table;
  table.columns = {"level",
                   "label",
                   "nodes",
                   "springs",
                   "ends",
                   "step",
                   "undamped_step",
                   "limited_by",
                   "spring_updates_per_second",
                   "cost_ratio",
                   "surface_error",
                   "surface_error_percent",
                   "shape_error",
                   "shape_error_percent",
                   "distance",
                   "distance_spread",
                   "energy_difference",
                   "simulated",
                   "ledger_error"};
  const auto& levels = comparison.levels;
  const double diagonal = base_diagonal(chain);
  for (const sim::LevelRuns& runs : levels) {
    const MassSpringModel& model = chain.levels.at(runs.level).model;
    const double cost = cost_per_second(runs);
    const double surface =
        mean_over(runs, [](const sim::StartResult& s) { return s.surface_error; });
    const double shape = mean_over(runs, [](const sim::StartResult& s) { return s.shape_error; });
    const double distance = mean_over(runs, [](const sim::StartResult& s) { return s.distance; });
    const double energy =
        mean_over(runs, [](const sim::StartResult& s) { return s.energy_difference; });
    const double simulated = mean_over(runs, [](const sim::StartResult& s) { return s.simulated; });
    table.rows.push_back({whole(runs.level), runs.label, whole(model.node_count()),
                          whole(model.spring_count()), whole(model.end_count()), runs.first.step,
                          runs.first.undamped_step, to_string(runs.first.limited_by), cost,
                          cost_per_second(levels.front()) / cost, surface, 100 * surface / diagonal,
                          shape, 100 * shape / diagonal, distance, distance_spread(runs), energy,
                          simulated, largest_ledger_error(runs)});
  }
  return table;
}

Table starts_table(const sim::Comparison& comparison) {
  Table table;
  table.columns = {"level",
                   "label",
                   "start",
                   "distance",
                   "surface_error",
                   "shape_error",
                   "energy_difference",
                   "simulated",
                   "spring_updates",
                   "ledger_error",
                   "unconverged_steps",
                   "first_crossing",
                   "first_inversion",
                   "most_inverted",
                   "inverted_at_end"};
  for (const sim::LevelRuns& runs : comparison.levels)
    for (std::size_t i = 0; i < runs.starts.size(); ++i) {
      const sim::StartResult& start = runs.starts[i];
      table.rows.push_back({whole(runs.level), runs.label, whole(i + 1), start.distance,
                            start.surface_error, start.shape_error, start.energy_difference,
                            start.simulated, whole(start.spring_updates), start.ledger_error,
                            whole(start.unconverged_steps),
                            start.first_crossing ? Cell(*start.first_crossing) : Cell(),
                            start.first_inversion ? Cell(*start.first_inversion) : Cell(),
                            whole(start.most_inverted), whole(start.inverted_at_end)});
    }
  return table;
}

Table timings_table(const sim::Comparison& comparison) {
  Table table;
  table.columns = {"level",
                   "label",
                   "start",
                   "wall_seconds",
                   "simulated",
                   "spring_updates",
                   "spring_updates_per_wall_second",
                   "real_time_factor"};
  for (const sim::LevelRuns& runs : comparison.levels)
    for (std::size_t i = 0; i < runs.starts.size(); ++i) {
      const sim::StartResult& start = runs.starts[i];
      const double wall = std::max(start.wall_seconds, 1e-9);  // the clock resolution may give 0
      table.rows.push_back({whole(runs.level), runs.label, whole(i + 1), wall, start.simulated,
                            whole(start.spring_updates),
                            static_cast<double>(start.spring_updates) / wall,
                            start.simulated / wall});
    }
  return table;
}

}  // namespace springlod::report
