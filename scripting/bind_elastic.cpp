// Elasticity of mass-spring models: modes and static loads.

#include <fmt/format.h>
#include <lua.hpp>

#include "model/modes.hpp"
#include "model/static_loads.hpp"
#include "scripting/call.hpp"
#include "scripting/values.hpp"

namespace springlod {

namespace {

constexpr const char* kGroup = "Models";

int modes_binding(Call& call) {
  const auto value = call.value<ModelValue>(1);
  ModeOptions options;
  options.progress = call.progress();
  TableReader reader = call.options(2);
  reader.read("count", options.count);
  reader.read("accuracy", options.accuracy);
  reader.read("seed", options.seed);
  reader.finish();
  const Modes found = lowest_modes(*value->model, options);
  lua_State* L = call.lua();
  begin_list(L, found.modes.size());
  for (std::size_t i = 0; i < found.modes.size(); ++i) {
    begin_table(L);
    set_field(L, "frequency", found.modes[i].frequency());
    set_field(L, "residual", found.modes[i].residual);
    set_field(L, "shape", found.modes[i].shape);
    end_list_entry(L, i + 1);
  }
  return 1;
}

int static_loads_binding(Call& call) {
  const MassSpringModel& model = *call.value<ModelValue>(1)->model;
  const std::vector<StaticLoad> loads = smooth_loads(model);
  const std::vector<StaticSolution> solutions =
      solve_static(elastic_body(model, {.progress = call.progress()}), loads);
  lua_State* L = call.lua();
  begin_list(L, loads.size());
  for (std::size_t i = 0; i < loads.size(); ++i) {
    begin_table(L);
    set_field(L, "name", loads[i].name);
    set_field(L, "compliance", solutions[i].compliance);
    set_field(L, "residual", solutions[i].residual);
    set_field(L, "force", loads[i].force);
    set_field(L, "displacement", solutions[i].displacement);
    end_list_entry(L, i + 1);
  }
  return 1;
}

}  // namespace

void describe_elastic(Api& api) {
  const Parameter model{.name = "model", .type = "Model", .help = "a model or a level of a chain"};
  const ModeOptions usual;
  api.add(FunctionEntry{
      .name = "modes",
      .group = kGroup,
      .summary = "The lowest frequencies at which the model swings when nothing holds it.",
      .arguments = {model},
      .options = {{.name = "count",
                   .type = "integer",
                   .fallback = fmt::format("{}", usual.count),
                   .help = "modes wanted; motions that no spring resists are not among them"},
                  {.name = "accuracy",
                   .type = "number",
                   .fallback = fmt::format("{}", usual.accuracy),
                   .help = "bound of the relative error of each squared frequency"},
                  {.name = "seed",
                   .type = "integer",
                   .fallback = fmt::format("{}", usual.seed),
                   .help = "of the start of the iteration"}},
      .returns = "list of tables, lowest first: frequency [Hz], residual (bound of the relative "
                 "error of its square), shape (for each node {x, y, z}; sum of mass times square "
                 "= 1)",
      .errors = "count 0, an accuracy outside 1e-12..0.1, hundreds of loose nodes in a large part.",
      .example = "for _, mode in ipairs(s.modes(base, {count = 5})) do print(mode.frequency) end",
      .call = modes_binding});
  api.add(FunctionEntry{
      .name = "static_loads",
      .group = kGroup,
      .summary = "How the model gives way to nine smooth loads: three stretches, three shears, two "
                 "bends and a twist of its longest axis, 1 N each.",
      .arguments = {model},
      .returns = "list of tables: name, compliance [J] (forces times displacements), residual, "
                 "force (for each node {x, y, z} [N]), displacement (likewise [m], without rigid "
                 "motion)",
      .errors = "Hundreds of loose nodes in a large part.",
      .example = "for _, load in ipairs(s.static_loads(base)) do print(load.name, "
                 "load.compliance) end",
      .call = static_loads_binding});
}

}  // namespace springlod
