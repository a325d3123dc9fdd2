// Stability maps: which integrator holds out where, and how exact it is there.

#include <cmath>
#include <map>

#include <fmt/format.h>
#include <lua.hpp>

#include "report/tables.hpp"
#include "scripting/bind/chart_table.hpp"
#include "scripting/bind/integrator_word.hpp"
#include "scripting/bind/topics.hpp"
#include "scripting/bind/values.hpp"
#include "scripting/engine/call.hpp"
#include "sim/study/stability_map.hpp"

namespace springlod::scripting {

namespace {

std::vector<std::uint32_t> read_whole_numbers(TableReader& reader, std::string_view name) {
  std::vector<double> numbers;
  reader.read(name, numbers);
  std::vector<std::uint32_t> whole;
  for (const double number : numbers) {
    constexpr double kMost = 1e6;
    if (!(number >= 0 && number <= kMost && number == std::floor(number)))
      reader.refuse(name,
                    fmt::format("a list of whole numbers of 0 to {:.0f}, got {}", kMost, number));
    whole.push_back(static_cast<std::uint32_t>(number));
  }
  return whole;
}

int stability_binding(Call& call) {
  const auto chain = call.value<LodAsset>(1);
  sim::StabilityOptions options;
  options.seed = call.session().settings().seed;
  options.threads = call.session().settings().threads;
  TableReader reader = call.options(2);
  options.levels = read_whole_numbers(reader, "levels");
  reader.read("ratios", options.ratios);
  reader.read("remake_levels", options.remake_levels);
  read_integrators(reader, "integrators", options.integrators);
  if (auto iterations = read_whole_numbers(reader, "iterations"); !iterations.empty())
    options.iterations = std::move(iterations);
  reader.read("steps", options.steps);
  reader.read("implicit_steps", options.implicit_steps);
  reader.read("sweep_steps", options.sweep_steps);
  reader.read("damping", options.damping);
  reader.read("absolute_steps", options.absolute_steps);
  reader.read("periods", options.periods);
  reader.read("duration", options.duration);
  reader.read("threads", options.threads);
  reader.read("seed", options.seed);
  reader.finish();
  options.progress = call.progress();
  return call.give(std::shared_ptr<const sim::StabilityMap>(
      std::make_shared<sim::StabilityMap>(sim::stability_map(chain->chain, options))));
}

int give_table(Call& call, const report::Table& table) {
  push_rows(call.lua(), table);
  push(call.lua(), table.columns);
  return 2;
}

void push_verdicts(lua_State* L, const sim::StabilityMap& map) {
  std::map<sim::Verdict, std::size_t> counts;
  for (const sim::StabilityPoint& point : map.points) ++counts[point.verdict];
  begin_table(L);
  for (const auto& [verdict, count] : counts) set_field(L, to_string(verdict), count);
}

void describe_map(Api& api) {
  TypeBuilder<sim::StabilityMap> type(
      "How each integrator did with each level, stiffness ratio and step. s.chart draws it.",
      [](const sim::StabilityMap& map) {
        std::size_t stable = 0;
        for (const sim::StabilityPoint& point : map.points) stable += point.stable ? 1 : 0;
        return fmt::format("StabilityMap: {} points, {} of them stable; stiff part: {}",
                           map.points.size(), stable, map.stiff_part);
      });
  type.field("stiff_part", "string", "what the ratio makes stiff: a material, or one half",
             [](const sim::StabilityMap& map) { return map.stiff_part; });
  type.table_field("verdicts", "table", "number of points of each verdict that occurs",
                   push_verdicts);
  type.method({.name = "table",
               .summary = "What came of every point.",
               .returns = "list of tables, list of their keys: " + report::stability_columns_help(),
               .call = [](Call& call) {
                 return give_table(call, report::stability_table(*call.self<sim::StabilityMap>()));
               }});
  type.method(
      {.name = "bodies",
       .summary = "What the points of each level and ratio share.",
       .returns = "list of tables, list of their keys: " + report::stability_bodies_columns_help(),
       .call = [](Call& call) {
         return give_table(call, report::stability_bodies_table(*call.self<sim::StabilityMap>()));
       }});
  type.method({.name = "timings",
               .summary = "Measured times, which are never the same twice.",
               .returns = "list of tables, list of their keys: level, integrator, iterations, "
                          "ratio, step [s], wall_seconds, wall_seconds_per_second (of simulated "
                          "time)",
               .call = [](Call& call) {
                 return give_table(
                     call, report::stability_timings_table(*call.self<sim::StabilityMap>()));
               }});
  api.add(type.build());
}

std::string list_text(const std::vector<double>& values) {
  return fmt::format("{{{:g}}}", fmt::join(values, ", "));
}

std::vector<Parameter> parameters() {
  const sim::StabilityOptions usual;
  return {
      {.name = "levels", .type = "list of integers", .fallback = "all", .help = "0 is the base"},
      {.name = "ratios",
       .type = "list of numbers",
       .fallback = list_text(usual.ratios),
       .help = "Young's modulus of the stiff part over that of the softest material, which stays; "
               "of one material, the half beyond the center of mass is made stiff"},
      {.name = "remake_levels",
       .type = "boolean",
       .fallback = "true",
       .help = "false: only the base follows the ratio, levels stay as they were made"},
      {.name = "damping",
       .type = "boolean",
       .fallback = "false",
       .help = "whether springs keep theirs; without it every loss of energy is the scheme's own"},
      {.name = "integrators", .type = "list of strings", .fallback = "all", .help = "as for run"},
      {.name = "iterations",
       .type = "list of integers",
       .fallback = "the default of each",
       .help = "of xpbd and projective_dynamics, which run with each of these"},
      {.name = "steps",
       .type = "list of numbers",
       .fallback = list_text(usual.steps),
       .help = "of the explicit integrators, as parts of the predicted limit"},
      {.name = "implicit_steps",
       .type = "list of numbers",
       .fallback = list_text(usual.implicit_steps),
       .help = "of backward Euler, as parts of the period of the body's slowest mode"},
      {.name = "sweep_steps",
       .type = "list of numbers",
       .fallback = list_text(usual.sweep_steps),
       .help = "of xpbd and projective_dynamics, likewise"},
      {.name = "absolute_steps",
       .type = "list of quantities",
       .dimension = Dimension::time,
       .fallback = "none",
       .help = "for all integrators, in place of these"},
      {.name = "periods",
       .type = "number",
       .fallback = fmt::format("{:g}", usual.periods),
       .help = "length of each run in periods of the slowest mode"},
      {.name = "duration",
       .type = "quantity",
       .dimension = Dimension::time,
       .fallback = "from periods",
       .help = "length of each run"},
      {.name = "threads",
       .type = "integer",
       .fallback = "s.threads",
       .help = "0: all cores; never changes a result"},
      {.name = "seed",
       .type = "integer",
       .fallback = "s.seed",
       .help = "of the search for frequencies"}};
}

}  // namespace

void describe_stability(Api& api) {
  describe_map(api);
  api.add(FunctionEntry{
      .name = "stability",
      .group = "Simulation",
      .summary = "Maps step and stiffness ratio for every level and integrator: what is stable, "
                 "when it diverges, what it is off a fine run, what it costs.",
      .arguments = {{.name = "chain", .type = "LodChain", .help = "levels to probe"}},
      .options = parameters(),
      .returns = "StabilityMap",
      .errors = "A level that is not there, a number that is not above 0, a base without springs. "
                "Runs that diverge are no errors: they are what the map shows.",
      .example = "local map = s.stability(chain, {levels = {0}, ratios = {1, 1000}})\n"
                 "s.chart(\"out/map.svg\", map)",
      .call = stability_binding});
}

}  // namespace springlod::scripting
