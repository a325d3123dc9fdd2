// Simplifying a model into a chain of levels, and reading the chain.

#include <algorithm>
#include <utility>

#include <fmt/format.h>
#include <lua.hpp>

#include "base/error.hpp"
#include "lod/build.hpp"
#include "lod/quality/certify.hpp"
#include "scripting/bind/calibration_option.hpp"
#include "scripting/bind/grouping_script.hpp"
#include "scripting/bind/node_choice.hpp"
#include "scripting/bind/topics.hpp"
#include "scripting/bind/values.hpp"
#include "scripting/engine/call.hpp"

namespace springlod::scripting {

namespace {

constexpr const char* kGroup = "Levels of detail";

void read_guard(Call& call, TableReader& reader, lod::GuardOptions& guard) {
  const int table = reader.raw("guard");
  if (table == 0) return;
  TableReader limits = call.record(table, "Guard", "simplify: guard");
  limits.read("coincident_fraction", guard.coincident_fraction);
  limits.read("least_springs", guard.least_springs);
  limits.read("least_rigidity", guard.least_rigidity);
  limits.finish();
}

int simplify_binding(Call& call) {
  const auto base = call.value<ModelValue>(1);
  if (base->chain && base->level != 0)
    call.refuse(1, "a base model (level 0); a coarser level cannot be the base of a chain");
  lod::SimplifyOptions options;
  TableReader reader = call.options(2);
  reader.read("keep", options.keep);
  if (!options.keep.empty()) options.levels = static_cast<std::uint32_t>(options.keep.size());
  reader.read("levels", options.levels);
  reader.choose("border", options.grouping.border,
                {{"none", lod::BorderRule::none},
                 {"weak", lod::BorderRule::weak},
                 {"strong", lod::BorderRule::strong}});
  reader.read("straight", options.straight);
  options.grouping.seed = call.session().settings().seed;
  reader.read("seed", options.grouping.seed);
  reader.read("grading", options.grouping.grading);
  reader.choose(
      "mass", options.mass,
      {{"proportional", lod::MassRule::proportional}, {"proximity", lod::MassRule::proximity}});
  reader.read("guards", options.guards);
  read_guard(call, reader, options.guard);
  read_grouping(reader, options);
  read_calibration(call, reader, *base->model, options);
  reader.finish();
  options.progress = call.progress();

  auto asset = std::make_shared<LodAsset>();
  asset->chain = lod::simplify(*base->model, options);
  if (options.calibration == lod::Calibration::modes)
    lod::certify(asset->chain, {.modes = std::max(1U, options.calibrate.targets.modes),
                                .anchored = options.calibrate.targets.anchored,
                                .tolerance = options.calibrate.fit.tolerance,
                                .threads = options.calibrate.threads,
                                .progress = call.progress()});
  if (base->surface) {
    asset->surface = *base->surface;
    asset->surface_of_base = *base->surface_of_base;
  }
  asset->provenance = base->provenance;
  asset->provenance.set("simplify", asset->chain.levels.back().made_by);
  return call.give(std::shared_ptr<const LodAsset>(asset));
}

std::uint32_t level_number(Call& call, const LodAsset& asset) {
  return static_cast<std::uint32_t>(
      call.integer(1, 0, static_cast<long long>(asset.chain.levels.size()) - 1));
}

int level_method(Call& call) {
  const auto self = call.self<LodAsset>();
  return call.give(level_value(self, level_number(call, *self)));
}

int group_map_method(Call& call) {
  const auto self = call.self<LodAsset>();
  std::vector<std::uint32_t> map = self->chain.levels[level_number(call, *self)].of_base.of;
  for (std::uint32_t& node : map) ++node;
  return call.give(map);
}

int carried_method(Call& call) {
  const auto self = call.self<LodAsset>();
  const Level& level = self->chain.levels[level_number(call, *self)];
  std::vector<std::uint32_t> nodes = carried(
      level.of_base,
      nodes_at(call.lua(), call.index(2), self->chain.levels[0].model, "chain:carried: nodes"));
  for (std::uint32_t& node : nodes) ++node;
  return call.give(nodes);
}

std::string chain_text(const LodAsset& asset) {
  std::vector<std::string> nodes;
  std::vector<std::string> springs;
  std::vector<std::string> ends;
  for (const Level& level : asset.chain.levels) {
    nodes.push_back(fmt::format("{}", level.model.node_count()));
    springs.push_back(fmt::format("{}", level.model.spring_count()));
    ends.push_back(fmt::format("{}", level.model.end_count()));
  }
  return fmt::format("LodChain: {} nodes, {} springs ({} ends)", fmt::join(nodes, " -> "),
                     fmt::join(springs, " -> "), fmt::join(ends, " -> "));
}

void describe_chain(Api& api) {
  TypeBuilder<LodAsset> type(
      "Models of one body from fine to coarse; chain[0] is the base, chain[n] level n.",
      chain_text);
  type.shared_field("levels", "list of Model", "levels from the base on: levels[1] is chain[0]",
                    [](lua_State* L, const std::shared_ptr<const LodAsset>& chain) {
                      const auto count = static_cast<std::uint32_t>(chain->chain.levels.size());
                      begin_list(L, count);
                      for (std::uint32_t i = 0; i < count; ++i) {
                        push(L, level_value(chain, i));
                        end_list_entry(L, i + 1);
                      }
                    });
  type.field("coarsest", "integer", "number of the coarsest level",
             [](const LodAsset& asset) { return asset.chain.levels.size() - 1; });
  type.table_field("provenance", "table of strings", "where it came from",
                   [](lua_State* L, const LodAsset& asset) {
                     begin_table(L);
                     for (const auto& [key, entry] : asset.provenance.entries)
                       set_field(L, key.c_str(), entry);
                   });
  const Parameter level{
      .name = "level", .type = "integer", .help = "0 for the base, up to chain.coarsest"};
  type.method({.name = "level",
               .summary = "One level; the same as chain[level].",
               .arguments = {level},
               .returns = "Model",
               .call = level_method});
  type.method({.name = "group_map",
               .summary = "For every node of the base, the number of the node it went into.",
               .arguments = {level},
               .returns = "list of integers",
               .call = group_map_method});
  type.method({.name = "carried",
               .summary = "The nodes of a level that nodes of the base went into, such as anchored "
                          "ones: those with at least one of them in their group.",
               .arguments = {level,
                             {.name = "nodes",
                              .type = "list of integers or function",
                              .help = "of the base: their numbers, or a function of a Node that "
                                      "returns true for them"}},
               .returns = "list of integers, rising",
               .errors = "A node that the base does not have.",
               .example =
                   "local held = chain:carried(1, function(node) return node.x < 0.001 end)\n"
                   "print(s.modes(chain[1], {anchored = held})[1].frequency)",
               .call = carried_method});
  type.elements(
      [](const LodAsset& asset) { return static_cast<long long>(asset.chain.levels.size()) - 1; },
      [](lua_State* L, const std::shared_ptr<const LodAsset>& chain, long long number) {
        if (number < 0 || number >= static_cast<long long>(chain->chain.levels.size()))
          return false;
        push(L, level_value(chain, static_cast<std::uint32_t>(number)));
        return true;
      });
  api.add(type.build());
}

std::vector<Parameter> simplify_options() {
  const lod::SimplifyOptions usual;
  return {{.name = "levels",
           .type = "integer",
           .fallback = fmt::format("{}", usual.levels),
           .help = "levels besides the base, each merged from the one before"},
          {.name = "keep",
           .type = "list of numbers",
           .fallback = "as the grouping makes; of compact and metis 0.45, 0.2, ...",
           .help = "nodes of each level over those of the base, falling, met exactly; as many "
                   "levels as there are numbers"},
          {.name = "grouping",
           .type = "function, list of lists of node numbers, or one of",
           .fallback = "\"standard\"",
           .help = "which nodes merge: nearest first in random order (standard), low gradient of "
                   "material and short springs first (priority), gradient alone first "
                   "(priority_hard), round groups straight from the base (compact), graph "
                   "partitions that cut few springs (metis); a function of one node gives its "
                   "priority, of two nodes the "
                   "cost of merging them; lists name the groups of level 1 by hand, lists of such "
                   "lists those of level 1, 2, ...",
           .choices = {"standard", "priority", "priority_hard", "compact", "metis"}},
          {.name = "straight",
           .type = "boolean",
           .fallback = "false; true of compact and metis",
           .help = "each level is merged straight from the base, whatever the one before merged"},
          {.name = "border",
           .type = "one of",
           .fallback = "\"none\"",
           .help = "border nodes merge freely, only with each other (weak), or never (strong)",
           .choices = {"none", "weak", "strong"}},
          {.name = "seed",
           .type = "integer",
           .fallback = "s.seed",
           .help = "of the random order; the same seed gives the same bits"},
          {.name = "grading",
           .type = "number",
           .fallback = fmt::format("{}", lod::GroupingOptions{}.grading),
           .help = "of compact: 0 .. 1, by how much stiff materials get larger groups than soft "
                   "ones, for a longer step"},
          {.name = "node_priority",
           .type = "function(node) -> number",
           .fallback = "none",
           .help = "order in which nodes are visited, low first; node is a Node table"},
          {.name = "pair_cost",
           .type = "function(a, b) -> number",
           .fallback = "none",
           .help = "which neighbour merges first, low first; a and b are Node tables joined by a "
                   "spring; math.huge forbids the pair"},
          {.name = "mass",
           .type = "one of",
           .fallback = "\"proportional\"",
           .help = "a node has the masses of its group, or each piece of the base goes to the "
                   "nearest node",
           .choices = {"proportional", "proximity"}},
          {.name = "guards",
           .type = "boolean",
           .fallback = usual.guards ? "true" : "false",
           .help = "fuse nodes that would coincide or be floppy; false: the raw merge"},
          {.name = "guard",
           .type = "Guard",
           .fallback = "the limits of Guard",
           .help = "when a node counts as coincident or floppy"},
          {.name = "calibrate",
           .type = "one of",
           .fallback = "\"none\"",
           .help = "levels stay as they were merged; get the moduli of eq. 2 of the paper; or "
                   "swing and give way as the base does, with as long a step as that allows "
                   "(modes), and carry a certificate of it",
           .choices = {"none", "moduli", "modes"}},
          {.name = "calibration",
           .type = "Calibration",
           .fallback = "that of Calibration",
           .help = "what calibrate = \"modes\" aims at"}};
}

}  // namespace

void describe_lod(Api& api) {
  describe_chain(api);
  const lod::GuardOptions guard;
  api.add(RecordEntry{
      .name = "Guard",
      .summary = "Limits of the guards of simplify.",
      .fields = {{.name = "coincident_fraction",
                  .type = "number",
                  .fallback = fmt::format("{}", guard.coincident_fraction),
                  .help = "joined nodes nearer than this part of the mean spring length are fused"},
                 {.name = "least_springs",
                  .type = "integer",
                  .fallback = fmt::format("{}", guard.least_springs),
                  .help = "a node with fewer springs is floppy"},
                 {.name = "least_rigidity",
                  .type = "number",
                  .fallback = fmt::format("{}", guard.least_rigidity),
                  .help = "a node is floppy if lambda_min / lambda_max of its springs' sum k u u^T "
                          "is below"}},
      .example = "guard = {least_springs = 5}"});
  api.add(FunctionEntry{
      .name = "simplify",
      .group = kGroup,
      .summary = "Merges nodes, level by level, into a chain of coarser models.",
      .arguments = {{.name = "model", .type = "Model", .help = "the base: level 0"}},
      .options = simplify_options(),
      .returns = "LodChain",
      .errors = "A level that cannot get any coarser; groups by hand that overlap or do not hang "
                "together.",
      .example = "local chain = s.simplify(base, {levels = 2, grouping = \"priority\", border = "
                 "\"weak\", seed = 1})\n"
                 "local soft_first = s.simplify(base, {grouping = function(a, b)\n"
                 "  return a.material == b.material and 0 or math.huge\nend})",
      .call = simplify_binding});
  describe_calibrate(api);
  describe_refill(api);
}

}  // namespace springlod::scripting
