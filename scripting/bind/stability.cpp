// Stability maps: where each integrator is stable, and its error there.

#include <map>

#include <fmt/format.h>
#include <lua.hpp>

#include "report/tables.hpp"
#include "scripting/bind/tables/anchor_table.hpp"
#include "scripting/bind/tables/chart_table.hpp"
#include "scripting/bind/tables/options.hpp"
#include "scripting/bind/tables/stability_rows.hpp"
#include "scripting/bind/tables/values.hpp"
#include "scripting/bind/topics.hpp"
#include "scripting/engine/call.hpp"
#include "sim/study/stability_map.hpp"

namespace springlod::scripting {

namespace {

int stability_binding(Call& call) {
  const auto chain = call.value<ChainValue>(1);
  sim::StabilityOptions options;
  options.seed = call.session().settings().seed;
  options.threads = call.session().settings().threads;
  TableReader reader = call.options(2);
  read_options(call, reader, options);
  if (!chain->chain.levels.empty())
    options.anchors = read_anchors(call, reader, chain->chain.levels.front().model);
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
      "Stability and error of each integrator by level, stiffness ratio and step. s.chart draws "
      "the map.",
      [](const sim::StabilityMap& map) {
        std::size_t stable = 0;
        for (const sim::StabilityPoint& point : map.points) stable += point.stable ? 1 : 0;
        return fmt::format("StabilityMap: {} points, {} of them stable; stiff part: {}",
                           map.points.size(), stable, map.stiff_part);
      });
  type.field("stiff_part", "string", "stiff part of the body: a material, or one half",
             [](const sim::StabilityMap& map) { return map.stiff_part; });
  type.table_field("verdicts", "table", "number of points of each verdict that occurs",
                   push_verdicts);
  type.method({.name = "table",
               .summary = "Results of every point.",
               .returns = "list of tables, list of their keys: " + report::stability_columns_help(),
               .call = [](Call& call) {
                 return give_table(call, report::stability_table(*call.self<sim::StabilityMap>()));
               }});
  type.method(
      {.name = "bodies",
       .summary = "Data common to the points of each level and ratio.",
       .returns = "list of tables, list of their keys: " + report::stability_bodies_columns_help(),
       .call = [](Call& call) {
         return give_table(call, report::stability_bodies_table(*call.self<sim::StabilityMap>()));
       }});
  type.method({.name = "timings",
               .summary = "Measured wall times; not reproducible.",
               .returns = "list of tables, list of their keys: level, integrator, iterations, "
                          "ratio, step [s], wall_seconds, wall_seconds_per_second (of simulated "
                          "time)",
               .call = [](Call& call) {
                 return give_table(
                     call, report::stability_timings_table(*call.self<sim::StabilityMap>()));
               }});
  type.method({.name = "rows",
               .summary = "All of the map as plain tables, which can be stored and joined.",
               .returns = "list of StabilityRow",
               .call = [](Call& call) {
                 push_stability_rows(call.lua(), *call.self<sim::StabilityMap>());
                 return 1;
               }});
  api.add(type.build());
}

int join_binding(Call& call) {
  return call.give(std::shared_ptr<const sim::StabilityMap>(
      std::make_shared<sim::StabilityMap>(read_stability_rows(call, 1))));
}

std::vector<Parameter> stability_parameters() {
  std::vector<Parameter> parameters = session_parameters<sim::StabilityOptions>();
  parameters.push_back(anchors_parameter());
  return parameters;
}

}  // namespace

void describe_stability(Api& api) {
  describe_map(api);
  api.add(FunctionEntry{
      .name = "stability",
      .group = "Simulation",
      .summary = "Maps step and stiffness ratio for every level and integrator: verdict, time of "
                 "divergence, error against a fine run, and cost.",
      .arguments = {{.name = "chain", .type = "LodChain", .help = "levels to probe"}},
      .options = stability_parameters(),
      .returns = "StabilityMap",
      .errors =
          "A level that does not exist, a number that is not above 0, a base without springs. "
          "Diverged runs are results of the map, not errors.",
      .example = "local map = s.stability(chain, {levels = {0}, ratios = {1, 1000}})\n"
                 "s.chart(\"out/map.svg\", map)",
      .call = stability_binding});
  api.add(stability_row_entry());
  api.add(FunctionEntry{
      .name = "join_stability",
      .group = "Simulation",
      .summary = "Joins parts of a stability map that were computed apart, such as each level in a "
                 "process of its own.",
      .arguments = {{.name = "rows",
                     .type = "list of StabilityRow",
                     .help = "the rows of all parts, those of the same level and ratio together"}},
      .returns = "StabilityMap",
      .errors = "An entry that is no StabilityRow.",
      .example = "local map = s.join_stability(s.stability(chain, {ratios = {1}}):rows())",
      .call = join_binding});
}

}  // namespace springlod::scripting
