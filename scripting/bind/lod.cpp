// Simplifying a model into a chain of levels, and reading the chain.

#include <fmt/format.h>
#include <lua.hpp>

#include "lod/build.hpp"
#include "lod/transfer.hpp"
#include "scripting/bind/tables/grouping_script.hpp"
#include "scripting/bind/tables/node_choice.hpp"
#include "scripting/bind/tables/options.hpp"
#include "scripting/bind/tables/records.hpp"
#include "scripting/bind/tables/values.hpp"
#include "scripting/bind/topics.hpp"
#include "scripting/engine/call.hpp"
#include "scripting/engine/quantity.hpp"

namespace springlod::scripting {

namespace {

constexpr const char* kGroup = "Levels of detail";

int simplify_binding(Call& call) {
  const auto base = call.value<ModelValue>(1);
  if (base->chain && base->level != 0)
    call.refuse(1, "a base model (level 0); a coarser level cannot be the base of a chain");
  lod::SimplifyOptions options;
  options.grouping.seed = call.session().settings().seed;
  options.calibration.threads = call.session().settings().threads;
  options.progress = call.progress();
  TableReader reader = call.options(2);
  read_options(call, reader, options, base->model.get(), "grouping");
  if (!options.keep.empty() && !reader.has("levels"))
    options.levels = static_cast<std::uint32_t>(options.keep.size());
  read_grouping(reader, options);
  reader.finish();

  auto asset = std::make_shared<ChainValue>();
  asset->chain = lod::simplify(*base->model, options);
  if (base->surface) {
    asset->surface = *base->surface;
    asset->surface_of_base = *base->surface_of_base;
  }
  asset->provenance = base->provenance;
  asset->provenance.set("simplify", asset->chain.levels.back().made_by);
  return call.give(std::shared_ptr<const ChainValue>(asset));
}

std::uint32_t level_number(Call& call, const LodAsset& asset) {
  return static_cast<std::uint32_t>(
      call.integer(1, 0, static_cast<long long>(asset.chain.levels.size()) - 1));
}

int level_method(Call& call) {
  const auto self = call.self<ChainValue>();
  return call.give(level_value(self, level_number(call, *self)));
}

int group_map_method(Call& call) {
  const auto self = call.self<ChainValue>();
  std::vector<std::uint32_t> map = self->chain.levels[level_number(call, *self)].of_base.of;
  for (std::uint32_t& node : map) ++node;
  return call.give(map);
}

int carried_method(Call& call) {
  const auto self = call.self<ChainValue>();
  const Level& level = self->chain.levels[level_number(call, *self)];
  std::vector<std::uint32_t> nodes = mapped_nodes(
      level.of_base,
      nodes_at(call.lua(), call.index(2), self->chain.levels[0].model, "chain:carried: nodes"));
  for (std::uint32_t& node : nodes) ++node;
  return call.give(nodes);
}

/// One {x, y, z} for each node of a level.
std::vector<Vec3> vectors_of_nodes(Call& call, int number, const MassSpringModel& model) {
  lua_State* L = call.lua();
  const int list = call.index(number);
  const std::size_t count = lua_istable(L, list) ? lua_rawlen(L, list) : 0;
  if (count != model.node_count())
    call.refuse(number, fmt::format("a list of {} points {{x, y, z}}, one per node of the level",
                                    model.node_count()));
  std::vector<Vec3> vectors;
  for (std::size_t i = 1; i <= count; ++i) {
    lua_rawgeti(L, list, static_cast<lua_Integer>(i));
    vectors.push_back(
        vector_at(L, -1, Dimension::number, fmt::format("chain:to_base: values[{}]", i)));
    lua_pop(L, 1);
  }
  return vectors;
}

int to_base_method(Call& call) {
  const auto self = call.self<ChainValue>();
  const std::uint32_t level = level_number(call, *self);
  return call.give(interpolate(lod::base_from_level(self->chain, level),
                               vectors_of_nodes(call, 2, self->chain.levels[level].model)));
}

std::string chain_text(const LodAsset& asset) {
  std::vector<std::string> nodes;
  std::vector<std::string> springs;
  for (const Level& level : asset.chain.levels) {
    nodes.push_back(fmt::format("{}", level.model.node_count()));
    springs.push_back(fmt::format("{}", level.model.spring_count()));
  }
  return fmt::format("LodChain: {} nodes, {} springs", fmt::join(nodes, " -> "),
                     fmt::join(springs, " -> "));
}

void describe_chain(Api& api) {
  TypeBuilder<ChainValue> type(
      "Models of one body from fine to coarse; chain[0] is the base, chain[n] level n.",
      chain_text);
  type.shared_field("levels", "list of Model", "levels from the base on: levels[1] is chain[0]",
                    [](lua_State* L, const std::shared_ptr<const ChainValue>& chain) {
                      const auto count = static_cast<std::uint32_t>(chain->chain.levels.size());
                      begin_list(L, count);
                      for (std::uint32_t i = 0; i < count; ++i) {
                        push(L, level_value(chain, i));
                        end_list_entry(L, i + 1);
                      }
                    });
  type.field("coarsest", "integer", "number of the coarsest level",
             [](const LodAsset& asset) { return asset.chain.levels.size() - 1; });
  type.table_field(
      "provenance", "table of strings", "origin: version, script, parameters, seed and hashes",
      [](lua_State* L, const LodAsset& asset) { push_provenance(L, asset.provenance); });
  const Parameter level{
      .name = "level", .type = "integer", .help = "0 for the base, up to chain.coarsest"};
  type.method({.name = "level",
               .summary = "One level; the same as chain[level].",
               .arguments = {level},
               .returns = "Model",
               .call = level_method});
  type.method(
      {.name = "group_map",
       .summary =
           "For every node of the base, the number of the level's node whose group contains it.",
       .arguments = {level},
       .returns = "list of integers",
       .call = group_map_method});
  type.method({.name = "carried",
               .summary = "The nodes of a level whose groups contain at least one of the given "
                          "base nodes, such as anchored ones.",
               .arguments = {level,
                             {.name = "nodes",
                              .type = "list of integers or function",
                              .help = "nodes of the base: their numbers, or a function of a Node "
                                      "that returns true for them"}},
               .returns = "list of integers, ascending",
               .errors = "A node that the base does not have.",
               .example =
                   "local held = chain:carried(1, function(node) return node.x < 0.001 end)\n"
                   "print(s.modes(chain[1], {anchored = held})[1].frequency)",
               .call = carried_method});
  type.method({.name = "to_base",
               .summary =
                   "Brings values at the nodes of a level to the nodes of the base, as the drawn "
                   "surface of the level follows them.",
               .arguments = {level,
                             {.name = "values",
                              .type = "list of {x, y, z}",
                              .help = "one for each node of the level: positions, velocities or "
                                      "displacements"}},
               .returns = "list of {x, y, z}, one for each node of the base",
               .errors = "A list of another length.",
               .example = "local bent = s.deflect(chain[1], {force = {[1] = {1, 0, 0}}})\n"
                          "print(s.inspect(chain:to_base(1, bent.displacement)[1]))",
               .call = to_base_method});
  type.elements(
      [](const LodAsset& asset) { return static_cast<long long>(asset.chain.levels.size()) - 1; },
      [](lua_State* L, const std::shared_ptr<const ChainValue>& chain, long long number) {
        if (number < 0 || number >= static_cast<long long>(chain->chain.levels.size()))
          return false;
        push(L, level_value(chain, static_cast<std::uint32_t>(number)));
        return true;
      });
  api.add(type.build());
}

std::vector<Parameter> simplify_options() {
  std::vector<Parameter> parameters = session_parameters<lod::SimplifyOptions>();
  extend_grouping_parameter(find_parameter(parameters, "grouping"));
  const std::vector<Parameter> functions = grouping_function_parameters();
  parameters.insert(parameters.end(), functions.begin(), functions.end());
  return parameters;
}

}  // namespace

void describe_lod(Api& api) {
  describe_chain(api);
  api.add(RecordEntry{.name = "Guard",
                      .summary = "Limits of the guards of simplify.",
                      .fields = parameters_of<lod::GuardOptions>(),
                      .example = "guard = {least_springs = 5}"});
  api.add(FunctionEntry{
      .name = "simplify",
      .group = kGroup,
      .summary = "Merges nodes, level by level, into a chain of coarser models.",
      .arguments = {{.name = "model", .type = "Model", .help = "the base: level 0"}},
      .options = simplify_options(),
      .returns = "LodChain",
      .errors =
          "A level that cannot become coarser; given groups that overlap or are not connected.",
      .example = "local chain = s.simplify(base, {levels = 2, grouping = \"priority\", border = "
                 "\"weak\", seed = 1})\n"
                 "local soft_first = s.simplify(base, {grouping = function(a, b)\n"
                 "  return a.material == b.material and 0 or math.huge\nend})",
      .call = simplify_binding});
  describe_calibrate(api);
  describe_refill(api);
}

}  // namespace springlod::scripting
