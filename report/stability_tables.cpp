
#include "report/tables.hpp"

namespace springlod::report {
std::string stability_columns_help() {
  return "level, nodes, springs, integrator, iterations (at most; 0: explicit), ratio (of Young's "
         "moduli, stiff over soft), step [s], limit (predicted for the integrator, of the nodes "
         "that are not held; of symplectic Euler for implicit ones) [s], step_over_limit, stable "
         "(1: the run was completed with "
         "less than twice its initial energy), verdict, diverged_at [s], node (that diverged or "
         "moves in a mechanism; from 1), energy_drift (of the scheme, over the energy at the "
         "start and that from moving anchors), error (rms distance from the reference run over its "
         "rms displacement), cost "
         "(spring updates per simulated second), unconverged_steps; values that do not apply are "
         "empty strings";
}

Table stability_table(const sim::StabilityMap& map) {
  Table table;
  table.columns = {
      "level", "nodes",        "springs",         "integrator", "iterations",       "ratio",
      "step",  "limit",        "step_over_limit", "stable",     "verdict",          "diverged_at",
      "node",  "energy_drift", "error",           "cost",       "unconverged_steps"};
  for (const sim::StabilityPoint& point : map.points) {
    const sim::StabilityBody& body = map.bodies[point.body];
    const auto if_finished = [&](double value) { return point.finished ? Cell(value) : Cell(); };
    table.rows.push_back({whole(body.level), whole(body.nodes), whole(body.springs),
                          to_string(point.integrator), whole(point.iterations), body.ratio,
                          point.step, point.limit, point.step / point.limit,
                          whole(point.stable ? 1 : 0), to_string(point.verdict),
                          point.diverged_at ? Cell(*point.diverged_at) : Cell(),
                          point.node ? whole(std::uint64_t{*point.node} + 1) : Cell(),
                          if_finished(point.energy_drift), if_finished(point.error),
                          if_finished(point.cost), whole(point.unconverged_steps)});
  }
  return table;
}

std::string stability_bodies_columns_help() {
  return "level, ratio, nodes, springs, limit (of symplectic Euler) [s], limited_by (springs or "
         "damping), period (of the base's slowest mode) [s], duration (of each run) [s], "
         "frequency_error (mean relative error of the six lowest frequencies against the base at "
         "the same ratio), reference_error (error of the reference run itself), loose_nodes "
         "(number of nodes in mechanisms)";
}

Table stability_bodies_table(const sim::StabilityMap& map) {
  Table table;
  table.columns = {"level",           "ratio",           "nodes",      "springs",
                   "limit",           "limited_by",      "period",     "duration",
                   "frequency_error", "reference_error", "loose_nodes"};
  for (const sim::StabilityBody& body : map.bodies)
    table.rows.push_back({whole(body.level), body.ratio, whole(body.nodes), whole(body.springs),
                          body.limit, to_string(body.limited_by), body.period, body.duration,
                          body.frequency_error, body.reference_error, whole(body.loose_nodes)});
  return table;
}

Table stability_timings_table(const sim::StabilityMap& map) {
  Table table;
  table.columns = {"level",
                   "integrator",
                   "iterations",
                   "ratio",
                   "step",
                   "wall_seconds",
                   "wall_seconds_per_second"};
  for (const sim::StabilityPoint& point : map.points) {
    if (!point.finished) continue;
    const sim::StabilityBody& body = map.bodies[point.body];
    table.rows.push_back({whole(body.level), to_string(point.integrator), whole(point.iterations),
                          body.ratio, point.step, point.wall_seconds,
                          point.wall_seconds / body.duration});
  }
  return table;
}

}  // namespace springlod::report
