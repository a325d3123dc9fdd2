// Picking a level for a scene, by error or by cost.

#include "sim/study/pick.hpp"

#include <string>
#include <vector>

#include <fmt/format.h>
#include <lua.hpp>

#include "lod/quality/certify.hpp"
#include "report/pick_text.hpp"
#include "scripting/bind/tables/chart_table.hpp"
#include "scripting/bind/tables/options.hpp"
#include "scripting/bind/tables/run_options.hpp"
#include "scripting/bind/tables/scenario_table.hpp"
#include "scripting/bind/tables/start_overlap.hpp"
#include "scripting/bind/tables/values.hpp"
#include "scripting/bind/topics.hpp"
#include "scripting/engine/call.hpp"

namespace springlod::scripting {

struct PickValue {
  sim::Pick pick;
  std::shared_ptr<const ChainValue> chain;
};
template <>
inline constexpr const char* kValueName<PickValue> = "Pick";

namespace {

/// The chain with a certificate for each level that has springs. Existing certificates are kept:
/// those of a calibration may have been measured with options of its own.
std::shared_ptr<const ChainValue> certified(Call& call,
                                            const std::shared_ptr<const ChainValue>& given) {
  std::vector<std::uint32_t> missing;
  for (std::uint32_t level = 1; level < given->chain.levels.size(); ++level)
    if (!given->chain.levels[level].certificate &&
        given->chain.levels[level].model.spring_count() > 0)
      missing.push_back(level);
  if (missing.empty()) return given;
  call.session().console().say(fmt::format(
      "pick: certifying level{} {}, which had no certificate; s.certify and s.save keep "
      "it in the asset",
      missing.size() == 1 ? "" : "s", fmt::join(missing, ", ")));
  auto asset = std::make_shared<ChainValue>(LodAsset(*given));
  lod::certify(asset->chain,
               {.threads = call.session().settings().threads, .progress = call.progress()});
  for (std::size_t level = 1; level < given->chain.levels.size(); ++level)
    if (given->chain.levels[level].certificate)
      asset->chain.levels[level].certificate = given->chain.levels[level].certificate;
  return asset;
}

int pick_binding(Call& call) {
  auto value = std::make_shared<PickValue>();
  value->chain = call.value<ChainValue>(1);
  const auto scenario = scenario_argument(call, 2);
  sim::PickOptions options;
  options.threads = call.session().settings().threads;
  options.progress = call.progress();
  TableReader reader = call.options(3);
  read_options(call, reader, options);
  options.contact = read_contact(reader);
  reader.finish();
  sim::validate(value->chain->chain, options);
  const MassSpringModel& base = value->chain->chain.levels.front().model;
  if (const auto text = overlap_warning("pick", base, *scenario))
    call.session().console().say(*text);
  if (!options.measure) value->chain = certified(call, value->chain);
  value->pick = sim::pick_level(value->chain->chain, *scenario, options);
  return call.give(std::shared_ptr<const PickValue>(value));
}

int table_method(Call& call) {
  const report::Table table = report::pick_table(call.self<PickValue>()->pick);
  push_rows(call.lua(), table);
  push(call.lua(), table.columns);
  return 2;
}

void describe_value(Api& api) {
  TypeBuilder<PickValue> type(
      "The level that a scene needs, as s.pick found it; prints as a few sentences.",
      [](const PickValue& value) { return report::pick_text(value.pick); });
  type.table_field("level", "integer",
                   "number of the picked level, 0 for the base; nil if no level stays within the "
                   "budget",
                   [](lua_State* L, const PickValue& value) {
                     if (value.pick.level)
                       push(L, *value.pick.level);
                     else
                       lua_pushnil(L);
                   });
  type.table_field("model", "Model", "the picked level, for s.run; nil if there is none",
                   [](lua_State* L, const PickValue& value) {
                     if (value.pick.level)
                       push(L, level_value(value.chain, *value.pick.level));
                     else
                       lua_pushnil(L);
                   });
  type.field("text", "string", "what the level gains and loses, in words",
             [](const PickValue& value) { return report::pick_text(value.pick); });
  type.field("measured", "boolean", "whether errors and costs are those of runs",
             [](const PickValue& value) { return value.pick.options.measure; });
  type.shared_field(
      "chain", "LodChain", "the chain, with the certificates that were measured",
      [](lua_State* L, const std::shared_ptr<const PickValue>& value) { push(L, value->chain); });
  type.method({.name = "table",
               .summary = "Cost and error of every level in the scene.",
               .returns = "list of tables, list of their keys: " + report::pick_columns_help(),
               .call = table_method});
  api.add(type.build());
}

}  // namespace

void describe_pick(Api& api) {
  describe_value(api);
  std::vector<Parameter> parameters = session_parameters<sim::PickOptions>();
  parameters.push_back(contact_parameter());
  api.add(FunctionEntry{
      .name = "pick",
      .group = "Simulation",
      .summary = "Picks a level for a scene: the coarsest within an error, or the most accurate "
                 "within a cost per frame.",
      .arguments = {{.name = "chain",
                     .type = "LodChain",
                     .help =
                         "levels to pick from; those without a certificate are certified first"},
                    scenario_parameter()},
      .options = parameters,
      .returns = "Pick",
      .errors = "Neither or both of error and budget; a chain of one level. As for run.",
      .example = "local pick = s.pick(chain, scene, {error = \"2 %\"})\n"
                 "print(pick, pick.level)\n"
                 "local run = s.run(pick.model, scene)",
      .call = pick_binding});
}

}  // namespace springlod::scripting
