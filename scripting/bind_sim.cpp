// Running one model, and comparing the levels of a chain.

#include <algorithm>
#include <utility>

#include <fmt/format.h>
#include <lua.hpp>

#include "model/error.hpp"
#include "report/comparison_tables.hpp"
#include "scripting/call.hpp"
#include "scripting/run_options.hpp"
#include "scripting/scenario_table.hpp"
#include "scripting/values.hpp"
#include "sim/compare.hpp"
#include "sim/ensemble.hpp"
#include "sim/run.hpp"

namespace springlod {

namespace {

constexpr const char* kGroup = "Simulation";

int run_binding(Call& call) {
  auto value = std::make_shared<TrajectoryValue>();
  value->model = call.value<ModelValue>(1);
  value->scenario = scenario_argument(call, 2);
  RunOptions options;
  TableReader reader = call.options(3);
  read_run_options(call, reader, options);
  reader.finish();
  value->trajectory = run(*value->model->model, *value->scenario, options);
  return call.give(std::shared_ptr<const TrajectoryValue>(value));
}

int compare_binding(Call& call) {
  auto value = std::make_shared<ComparisonValue>();
  value->chain = call.value<LodAsset>(1);
  const auto scenario = scenario_argument(call, 2);
  CompareOptions options;
  TableReader reader = call.options(3);
  options.seed = call.session().settings().seed;
  options.threads = call.session().settings().threads;
  reader.read("starts", options.starts);
  reader.read("jitter", options.jitter);
  reader.read("seed", options.seed);
  reader.read("threads", options.threads);
  reader.read("error_window", options.error_window);
  reader.read("variant", options.variant);
  read_run_options(call, reader, options.run);
  reader.finish();
  options.progress = call.progress();
  value->comparison = compare(value->chain->chain, *scenario, options);
  return call.give(std::shared_ptr<const ComparisonValue>(value));
}

int ensemble_binding(Call& call) {
  const auto model = call.value<ModelValue>(1);
  const auto scenario = scenario_argument(call, 2);
  EnsembleOptions options;
  TableReader reader = call.options(3);
  options.seed = call.session().settings().seed;
  options.threads = call.session().settings().threads;
  std::uint32_t first = options.first_start + 1;
  reader.read("first", first);
  if (first == 0) reader.refuse("first", "1 or more");
  options.first_start = first - 1;
  reader.read("starts", options.starts);
  reader.read("jitter", options.jitter);
  reader.read("seed", options.seed);
  reader.read("threads", options.threads);
  read_run_options(call, reader, options.run);
  reader.finish();
  options.progress = call.progress();
  const std::vector<EnsembleRun> runs = run_ensemble(*model->model, *scenario, options);
  lua_State* L = call.lua();
  begin_list(L, runs.size());
  std::size_t number = 0;
  for (const EnsembleRun& run : runs) {
    begin_table(L);
    set_field(L, "start", run.start + 1);
    set_field(L, "distance", run.distance);
    set_field(L, "simulated", run.simulated);
    set_field(L, "spring_updates", run.spring_updates);
    set_field(L, "ledger_error", run.ledger_error);
    end_list_entry(L, ++number);
  }
  return 1;
}

void push_frame(lua_State* L, const Frame& frame) {
  begin_table(L);
  set_field(L, "time", frame.time);
  set_field(L, "x", frame.x);
}

int frame_method(Call& call) {
  const auto self = call.self<TrajectoryValue>();
  const auto& frames = self->trajectory.frames;
  push_frame(call.lua(), frames[static_cast<std::size_t>(
                             call.integer(1, 1, static_cast<long long>(frames.size())) - 1)]);
  return 1;
}

void push_ledger(lua_State* L, const TrajectoryValue& value) {
  begin_list(L, value.trajectory.ledger.size());
  std::size_t number = 0;
  for (const LedgerEntry& entry : value.trajectory.ledger) {
    begin_table(L);
    set_field(L, "time", entry.time);
    set_field(L, "kinetic", entry.kinetic);
    set_field(L, "elastic", entry.elastic);
    set_field(L, "gravity", entry.gravity);
    set_field(L, "contact", entry.contact);
    set_field(L, "lost_damping", entry.lost_damping);
    set_field(L, "lost_friction", entry.lost_friction);
    set_field(L, "lost_contact", entry.lost_contact);
    set_field(L, "lost_switch", entry.lost_switch);
    set_field(L, "total", entry.total());
    end_list_entry(L, ++number);
  }
}

void push_final(lua_State* L, const TrajectoryValue& value) {
  begin_table(L);
  set_field(L, "time", value.trajectory.final.t);
  set_field(L, "x", value.trajectory.final.x);
  set_field(L, "v", value.trajectory.final.v);
}

void describe_trajectory(Api& api) {
  TypeBuilder<TrajectoryValue> type(
      "One run of one model; trajectory[i] is frame i, #trajectory their number.",
      [](const TrajectoryValue& value) {
        const Trajectory& t = value.trajectory;
        return fmt::format("Trajectory: {:.4g} s in {} steps of {:.4g} s, {} frames", t.simulated,
                           t.steps, t.step, t.frames.size());
      });
  const auto number = [&](const char* name, const char* help, auto get) {
    type.field(name, "number", help,
               [get](const TrajectoryValue& value) { return get(value.trajectory); });
  };
  number("step", "time step [s]", [](const Trajectory& t) { return t.step; });
  number("predicted_step", "predicted stable step, contacts included [s]",
         [](const Trajectory& t) { return t.predicted_step; });
  number("simulated", "simulated time [s]", [](const Trajectory& t) { return t.simulated; });
  number("wall_seconds", "measured time; never the same twice [s]",
         [](const Trajectory& t) { return t.wall_seconds; });
  type.field("steps", "integer", "number of steps",
             [](const TrajectoryValue& value) { return value.trajectory.steps; });
  type.field("spring_updates", "integer",
             "steps times springs: the cost that does not depend on "
             "the machine",
             [](const TrajectoryValue& value) { return value.trajectory.spring_updates; });
  type.field("frame_count", "integer", "number of frames",
             [](const TrajectoryValue& value) { return value.trajectory.frames.size(); });
  type.table_field("first_contact", "number", "time of the first contact [s], or nil",
                   [](lua_State* L, const TrajectoryValue& value) {
                     const auto& time = value.trajectory.first_contact;
                     time ? push(L, *time) : lua_pushnil(L);
                   });
  type.table_field("ledger", "list of tables",
                   "energies of each frame [J]: time, kinetic, elastic, gravity, contact, "
                   "lost_damping, lost_friction, lost_contact, lost_switch, total",
                   push_ledger);
  type.table_field("final", "table", "last state: time [s], x and v, lists of {x, y, z} by node",
                   push_final);
  type.method({.name = "frame",
               .summary = "One frame; the same as trajectory[number].",
               .arguments = {{.name = "number", .type = "integer", .help = "counted from 1"}},
               .returns = "table: time [s], x (list of {x, y, z} by node) [m]",
               .call = frame_method});
  type.elements(
      [](const TrajectoryValue& value) {
        return static_cast<long long>(value.trajectory.frames.size());
      },
      [](lua_State* L, const std::shared_ptr<const TrajectoryValue>& value, long long frame) {
        const auto& frames = value->trajectory.frames;
        if (frame < 1 || frame > static_cast<long long>(frames.size())) return false;
        push_frame(L, frames[static_cast<std::size_t>(frame - 1)]);
        return true;
      });
  api.add(type.build());
}

void push_rows(lua_State* L, const Table& table) {
  begin_list(L, table.rows.size());
  std::size_t number = 0;
  for (const auto& row : table.rows) {
    begin_table(L);
    for (std::size_t i = 0; i < row.size(); ++i) {
      // Cells are text; numbers become numbers again.
      if (lua_stringtonumber(L, row[i].c_str()) == 0) push(L, row[i]);
      end_field(L, table.columns[i].c_str());
    }
    end_list_entry(L, ++number);
  }
}

int table_method(Call& call) {
  const auto self = call.self<ComparisonValue>();
  const Table table = comparison_table(self->comparison, self->chain->chain);
  push_rows(call.lua(), table);
  push(call.lua(), table.columns);
  return 2;
}

int timings_method(Call& call) {
  const auto self = call.self<ComparisonValue>();
  const Table table = timings_table(self->comparison);
  push_rows(call.lua(), table);
  push(call.lua(), table.columns);
  return 2;
}

int starts_method(Call& call) {
  const auto self = call.self<ComparisonValue>();
  const Table table = starts_table(self->comparison);
  push_rows(call.lua(), table);
  push(call.lua(), table.columns);
  return 2;
}

std::string comparison_text(const ComparisonValue& value) {
  std::vector<std::string> labels;
  for (const LevelRuns& level : value.comparison.levels) labels.push_back(level.label);
  const std::size_t starts =
      value.comparison.levels.empty() ? 0 : value.comparison.levels.front().starts.size();
  return fmt::format("Comparison of {} in {}, {} start{}", fmt::join(labels, ", "),
                     value.comparison.scenario.name, starts, starts == 1 ? "" : "s");
}

void describe_comparison(Api& api) {
  TypeBuilder<ComparisonValue> type("Runs of every level of a chain from the same starts.",
                                    comparison_text);
  type.field("labels", "list of strings", "names of the levels", [](const ComparisonValue& value) {
    std::vector<std::string> labels;
    for (const LevelRuns& level : value.comparison.levels) labels.push_back(level.label);
    return labels;
  });
  type.method({.name = "table",
               .summary = "Cost and error of every level, means over the starts.",
               .returns = "list of tables, list of their keys: " + comparison_columns_help(),
               .call = table_method});
  type.method({.name = "starts",
               .summary = "What every level did in every start.",
               .returns = "list of tables, list of their keys: level, label, start, distance [m], "
                          "surface_error [m], shape_error [m], energy_difference, simulated [s], "
                          "spring_updates, ledger_error",
               .call = starts_method});
  type.method({.name = "timings",
               .summary = "Measured times, which are never the same twice.",
               .returns = "list of tables, list of their keys: level, label, start, wall_seconds, "
                          "simulated [s], spring_updates, spring_updates_per_wall_second, "
                          "real_time_factor",
               .call = timings_method});
  api.add(type.build());
}

std::vector<Parameter> start_parameters(std::uint32_t starts) {
  const CompareOptions usual;
  return {{.name = "starts",
           .type = "integer",
           .fallback = fmt::format("{}", starts),
           .help = "starts, the same for every level"},
          {.name = "jitter",
           .type = "number",
           .fallback = fmt::format("{}", usual.jitter),
           .help = "relative change of speed and height from start to start; the first has none"},
          {.name = "seed", .type = "integer", .fallback = "s.seed", .help = "of the jitter"},
          {.name = "threads",
           .type = "integer",
           .fallback = "s.threads",
           .help = "0: all cores; never changes a result"}};
}

std::vector<Parameter> compare_parameters() {
  const CompareOptions usual;
  std::vector<Parameter> parameters = start_parameters(usual.starts);
  parameters.push_back(
      {.name = "error_window",
       .type = "quantity",
       .dimension = Dimension::time,
       .fallback = fmt::format("{}", usual.error_window),
       .help = "errors are averaged up to so long after the base's first contact"});
  parameters.push_back({.name = "variant",
                        .type = "string",
                        .fallback = "none",
                        .help = "goes into the labels: \"hb\" makes \"LOD-hb-1\""});
  const std::vector<Parameter> run = run_parameters(RunOptions{});
  parameters.insert(parameters.end(), run.begin(), run.end());
  return parameters;
}

std::vector<Parameter> ensemble_parameters() {
  const EnsembleOptions usual;
  std::vector<Parameter> parameters = start_parameters(usual.starts);
  parameters.push_back(
      {.name = "first",
       .type = "integer",
       .fallback = fmt::format("{}", usual.first_start + 1),
       .help = "number of the first start: others than those of another ensemble"});
  const std::vector<Parameter> run = run_parameters(usual.run);
  parameters.insert(parameters.end(), run.begin(), run.end());
  return parameters;
}

}  // namespace

void describe_sim(Api& api) {
  describe_scenario(api);
  describe_trajectory(api);
  describe_comparison(api);
  const Parameter scenario{.name = "scenario",
                           .type = "Scenario",
                           .help = "what it goes through; a table for s.scenario will do"};
  api.add(FunctionEntry{
      .name = "run",
      .group = kGroup,
      .summary = "Runs a model under a scenario.",
      .arguments = {{.name = "model", .type = "Model", .help = "a model or a level of a chain"},
                    scenario},
      .options = run_parameters(RunOptions{}),
      .returns = "Trajectory",
      .errors = "A run that leaves the numbers: error.kind is \"unstable\", error.node and "
                "error.time say where and when.",
      .example = "local trajectory = s.run(chain[1], scene, {frame_rate = 30})",
      .call = run_binding});
  api.add(FunctionEntry{
      .name = "compare",
      .group = kGroup,
      .summary = "Runs every level of a chain from the same starts and measures cost and error.",
      .arguments = {{.name = "chain", .type = "LodChain", .help = "levels to compare"}, scenario},
      .options = compare_parameters(),
      .returns = "Comparison",
      .errors = "As for run.",
      .example = "local runs = s.compare(chain, scene, {starts = 24, jitter = 0.02})\n"
                 "print(s.inspect(runs:table()))",
      .call = compare_binding});
  api.add(FunctionEntry{
      .name = "ensemble",
      .group = kGroup,
      .summary = "Runs one model from many starts and keeps what each came to.",
      .arguments = {{.name = "model", .type = "Model", .help = "a model or a level of a chain"},
                    scenario},
      .options = ensemble_parameters(),
      .returns = "list of tables, one a start: start (its number), distance [m], simulated [s], "
                 "spring_updates, ledger_error. Starts of one seed and number are the same for "
                 "every level: pairs",
      .errors = "As for run.",
      .example = "local distances = {}\n"
                 "for i, run in ipairs(s.ensemble(chain[1], scene, {starts = 24})) do\n"
                 "  distances[i] = run.distance\nend",
      .call = ensemble_binding});
}

}  // namespace springlod
