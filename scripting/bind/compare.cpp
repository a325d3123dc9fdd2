// Comparing the levels of a chain, and many starts of one model.

#include "sim/study/compare.hpp"

#include <algorithm>
#include <limits>
#include <optional>
#include <string>

#include <fmt/format.h>
#include <lua.hpp>

#include "base/message.hpp"
#include "base/units.hpp"
#include "report/no_contact_text.hpp"
#include "report/tables.hpp"
#include "scripting/bind/tables/anchor_table.hpp"
#include "scripting/bind/tables/chart_table.hpp"
#include "scripting/bind/tables/options.hpp"
#include "scripting/bind/tables/run_options.hpp"
#include "scripting/bind/tables/scenario_table.hpp"
#include "scripting/bind/tables/start_overlap.hpp"
#include "scripting/bind/tables/value_list.hpp"
#include "scripting/bind/tables/values.hpp"
#include "scripting/bind/topics.hpp"
#include "scripting/engine/call.hpp"
#include "scripting/engine/inspect.hpp"
#include "sim/study/ensemble.hpp"
#include "sim/study/no_contact.hpp"

namespace springlod::scripting {

namespace {

constexpr const char* kGroup = "Simulation";

/// Prints warnings about runs that completed.
void warn(Console& console, const std::vector<sim::RunSummary>& runs, bool resisted) {
  std::size_t unconverged = 0;
  std::size_t inverted = 0;
  std::size_t at_end = 0;
  double first = std::numeric_limits<double>::infinity();
  for (const sim::RunSummary& run : runs) {
    if (run.unconverged_steps > 0) ++unconverged;
    if (run.inverted_at_end > 0) ++at_end;
    const std::optional<double>& time =
        run.first_inversion ? run.first_inversion : run.first_crossing;
    if (!time) continue;
    ++inverted;
    first = std::min(first, *time);
  }
  if (unconverged > 0)
    console.say(
        fmt::format("compare: in {} of {} the solver did not reach its tolerance in some "
                    "steps; use more iterations, a greater tolerance or a smaller step",
                    unconverged, counted(runs.size(), "run")));
  if (inverted > 0)
    console.say(
        fmt::format("compare: in {} of {} the body was inside out somewhere, the first "
                    "at t = {}, and in {} until the end; {}",
                    inverted, counted(runs.size(), "run"), format_quantity(first, Dimension::time),
                    at_end, inversion_hint(resisted)));
}

/// Prints a hint if damping limits the step of a level.
void hint_at_damping(Session& session, const MassSpringModel& base,
                     const std::vector<sim::LevelRuns>& levels) {
  const sim::LevelRuns* worst = nullptr;
  const auto fraction = [](const sim::LevelRuns& level) {
    return level.first.predicted_step / level.first.undamped_step;
  };
  std::size_t limited = 0;
  for (const sim::LevelRuns& level : levels) {
    if (level.first.limited_by != sim::StepBound::damping) continue;
    ++limited;
    if (worst == nullptr || fraction(level) < fraction(*worst)) worst = &level;
  }
  if (worst != nullptr && first_hint_at_damping(session, base))
    session.console().say(
        fmt::format("compare: damping shortens the steps of {} of {}, that of {} {}", limited,
                    counted(levels.size(), "level"), worst->label, damping_hint(worst->first)));
}

/// That the body touches nothing; held bodies without obstacles are not meant to.
std::optional<std::string> no_contact_of(const ComparisonValue& value) {
  const sim::Trajectory& base = value.comparison.levels.front().first;
  const std::optional<sim::NoContact> found = sim::no_contact(base, value.comparison.scenario);
  const bool held = !base.anchor_loads.empty();
  if (!found || (held && !found->nearest)) return std::nullopt;
  return report::no_contact_text(*found);
}

constexpr const char* kVariants = "variants";

/// The starts of the labels of each chain.
std::vector<std::string> read_variants(TableReader& reader, bool of_list,
                                       const sim::CompareOptions& options) {
  if (!of_list) {
    if (reader.has(kVariants)) reader.refuse(kVariants, "given for lists of chains only");
    return {options.variant};
  }
  if (!options.variant.empty())
    reader.refuse("variant", "given for one chain only: a list has variants = {\"a\", \"b\"}");
  std::vector<std::string> variants;
  reader.read(kVariants, variants);
  return variants;
}

/// What a user should know of runs that completed; the base is the same in all comparisons.
void say_what_happened(Session& session,
                       const std::vector<std::shared_ptr<const ComparisonValue>>& values,
                       const sim::CompareOptions& options) {
  const MassSpringModel& base = values.front()->chain->chain.levels.front().model;
  const std::size_t starts = values.front()->comparison.levels.front().starts.size();
  if (starts < options.starts)
    session.console().say(fmt::format(
        "compare: ran one start instead of {}, which would all be the same: {}", options.starts,
        options.jitter == 0 ? "the jitter is 0"
                            : "the body has no speed, and its height makes no difference"));
  if (const auto untouched = no_contact_of(*values.front()))
    session.console().say("compare: " + *untouched);
  std::vector<sim::RunSummary> all;
  for (const auto& value : values)
    for (const sim::LevelRuns& level : value->comparison.levels)
      if (level.level > 0 || value == values.front())
        all.insert(all.end(), level.starts.begin(), level.starts.end());
  warn(session.console(), all, sim::corners_resist(base, options.run));
  for (const auto& value : values) hint_at_damping(session, base, value->comparison.levels);
}

int compare_binding(Call& call) {
  const bool of_list = call.try_value<ChainValue>(1) == nullptr;
  const auto chains = values_at<ChainValue>(call, 1, "a LodChain, or a list of them");
  const auto scenario = scenario_argument(call, 2);
  sim::CompareOptions options;
  options.seed = call.session().settings().seed;
  options.threads = call.session().settings().threads;
  options.progress = call.progress();
  const MassSpringModel& base = chains.front()->chain.levels.front().model;
  TableReader reader = call.options(3);
  read_options(call, reader, options);
  const std::vector<std::string> variants = read_variants(reader, of_list, options);
  options.contact = read_contact(reader);
  options.run.anchors = read_anchors(call, reader, base);
  reader.finish();
  if (const auto text = overlap_warning("compare", base, *scenario))
    call.session().console().say(*text);
  std::vector<const LodChain*> compared;
  for (const auto& chain : chains) compared.push_back(&chain->chain);
  std::vector<sim::Comparison> comparisons = sim::compare(compared, *scenario, options, variants);
  std::vector<std::shared_ptr<const ComparisonValue>> values;
  for (std::size_t c = 0; c < chains.size(); ++c)
    values.push_back(std::make_shared<const ComparisonValue>(
        ComparisonValue{std::move(comparisons[c]), chains[c]}));
  say_what_happened(call.session(), values, options);
  if (!of_list) return call.give(values.front());
  call.give(values);
  print_inspected(call.lua());
  return 1;
}

int ensemble_binding(Call& call) {
  const auto model = call.value<ModelValue>(1);
  const auto scenario = scenario_argument(call, 2);
  sim::EnsembleOptions options;
  options.seed = call.session().settings().seed;
  options.threads = call.session().settings().threads;
  options.progress = call.progress();
  TableReader reader = call.options(3);
  std::uint32_t first = options.first_start + 1;
  reader.read("first", first);
  options.first_start = first - 1;
  read_options(call, reader, options);
  options.run.skin = skin_of(*model, read_contact(reader));
  options.run.anchors = read_anchors(call, reader, *model->model);
  reader.finish();
  const std::vector<sim::EnsembleRun> runs = sim::run_ensemble(*model->model, *scenario, options);
  lua_State* L = call.lua();
  begin_list(L, runs.size());
  std::size_t number = 0;
  for (const sim::EnsembleRun& run : runs) {
    begin_table(L);
    set_field(L, "start", run.start + 1);
    set_field(L, "distance", run.distance);
    set_field(L, "simulated", run.simulated);
    set_field(L, "spring_updates", run.spring_updates);
    set_field(L, "ledger_error", run.ledger_error);
    set_field(L, "unconverged_steps", run.unconverged_steps);
    if (run.first_crossing) set_field(L, "first_crossing", *run.first_crossing);
    if (run.first_inversion) set_field(L, "first_inversion", *run.first_inversion);
    set_field(L, "most_inverted", run.most_inverted);
    set_field(L, "inverted_at_end", run.inverted_at_end);
    end_list_entry(L, ++number);
  }
  return 1;
}

int table_method(Call& call) {
  const auto self = call.self<ComparisonValue>();
  const report::Table table = report::comparison_table(self->comparison, self->chain->chain);
  push_rows(call.lua(), table);
  push(call.lua(), table.columns);
  return 2;
}

int timings_method(Call& call) {
  const auto self = call.self<ComparisonValue>();
  const report::Table table = report::timings_table(self->comparison);
  push_rows(call.lua(), table);
  push(call.lua(), table.columns);
  return 2;
}

int starts_method(Call& call) {
  const auto self = call.self<ComparisonValue>();
  const report::Table table = report::starts_table(self->comparison);
  push_rows(call.lua(), table);
  push(call.lua(), table.columns);
  return 2;
}

std::string comparison_text(const ComparisonValue& value) {
  std::vector<std::string> labels;
  for (const sim::LevelRuns& level : value.comparison.levels) labels.push_back(level.label);
  const std::size_t starts =
      value.comparison.levels.empty() ? 0 : value.comparison.levels.front().starts.size();
  return fmt::format("Comparison of {} in {}, {}", fmt::join(labels, ", "),
                     value.comparison.scenario.name, counted(starts, "start"));
}

void describe_comparison(Api& api) {
  TypeBuilder<ComparisonValue> type("Runs of every level of a chain from the same starts.",
                                    comparison_text);
  type.field("labels", "list of strings", "names of the levels", [](const ComparisonValue& value) {
    std::vector<std::string> labels;
    for (const sim::LevelRuns& level : value.comparison.levels) labels.push_back(level.label);
    return labels;
  });
  type.table_field("no_contact", "string",
                   "what to change if the body touches nothing in the scene, else nil",
                   [](lua_State* L, const ComparisonValue& value) {
                     const std::optional<std::string> text = no_contact_of(value);
                     text ? push(L, *text) : lua_pushnil(L);
                   });
  type.method(
      {.name = "table",
       .summary = "Cost and error of every level, means over the starts.",
       .returns = "list of tables, list of their keys: " + report::comparison_columns_help(),
       .call = table_method});
  type.method({.name = "starts",
               .summary = "Results of every level in every start.",
               .returns = "list of tables, list of their keys: level, label, start, distance [m], "
                          "surface_error [m], shape_error [m], energy_difference, simulated [s], "
                          "spring_updates, ledger_error, unconverged_steps, first_crossing (time "
                          "of the first crossing [s], or \"\"), first_inversion (the same of "
                          "corners), most_inverted, inverted_at_end (numbers of corners)",
               .call = starts_method});
  type.method({.name = "timings",
               .summary = "Measured wall times; not reproducible.",
               .returns = "list of tables, list of their keys: level, label, start, wall_seconds, "
                          "simulated [s], spring_updates, spring_updates_per_wall_second, "
                          "real_time_factor",
               .call = timings_method});
  api.add(type.build());
}

std::vector<Parameter> compare_parameters() {
  std::vector<Parameter> parameters = session_parameters<sim::CompareOptions>();
  parameters.push_back({.name = kVariants,
                        .type = "list of strings",
                        .fallback = "none",
                        .help = "of a list of chains: start of the labels of each"});
  parameters.push_back(contact_parameter());
  parameters.push_back(anchors_parameter());
  return parameters;
}

std::vector<Parameter> ensemble_parameters() {
  const sim::EnsembleOptions usual;
  std::vector<Parameter> parameters = session_parameters<sim::EnsembleOptions>();
  parameters.push_back(
      {.name = "first",
       .type = "integer",
       .range = Range{1, 1e9},
       .fallback = fmt::format("{}", usual.first_start + 1),
       .help = "number of the first start, to add other starts to an earlier ensemble"});
  parameters.push_back(contact_parameter());
  parameters.push_back(anchors_parameter());
  return parameters;
}

}  // namespace

void describe_compare(Api& api) {
  describe_comparison(api);
  api.add(FunctionEntry{
      .name = "compare",
      .group = kGroup,
      .summary = "Runs every level of a chain from the same starts and measures cost and error. "
                 "The base of several chains runs once for all of them.",
      .arguments = {{.name = "chain",
                     .type = "LodChain",
                     .help = "levels to compare; or a list of chains of one base"},
                    scenario_parameter()},
      .options = compare_parameters(),
      .returns = "Comparison; a list of them for a list",
      .errors = "As for run. Chains of a list that have different bases.",
      .example = "local runs = s.compare(chain, scene, {starts = 24, jitter = 0.02})\n"
                 "print(s.inspect(runs:table()))",
      .call = compare_binding});
  api.add(FunctionEntry{
      .name = "ensemble",
      .group = kGroup,
      .summary = "Runs one model from many starts and returns the results of each.",
      .arguments = {{.name = "model", .type = "Model", .help = "a model or a level of a chain"},
                    scenario_parameter()},
      .options = ensemble_parameters(),
      .returns = "list of tables, one per start: start (its number), distance [m], simulated [s], "
                 "spring_updates, ledger_error, unconverged_steps, first_crossing (time of the "
                 "first crossing [s], or nil), first_inversion (the same of corners), "
                 "most_inverted, inverted_at_end (numbers of corners). Starts of equal seed and "
                 "number are the same for "
                 "every level, so samples are paired",
      .errors = "As for run.",
      .example = "local distances = {}\n"
                 "for i, run in ipairs(s.ensemble(chain[1], scene, {starts = 24})) do\n"
                 "  distances[i] = run.distance\nend",
      .call = ensemble_binding});
}

}  // namespace springlod::scripting
