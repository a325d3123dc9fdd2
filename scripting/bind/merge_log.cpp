// The merge log: contributions of merges to the errors of a level.

#include "lod/quality/merge_log.hpp"

#include <algorithm>
#include <numeric>
#include <vector>

#include <lua.hpp>

#include "scripting/bind/tables/options.hpp"
#include "scripting/bind/tables/values.hpp"
#include "scripting/bind/topics.hpp"
#include "scripting/engine/call.hpp"
#include "scripting/engine/result_table.hpp"

namespace springlod::scripting {
namespace {

void push_answers(lua_State* L, const lod::MergeStep& step) {
  begin_list(L, step.answers.size());
  for (std::size_t i = 0; i < step.answers.size(); ++i) {
    begin_table(L);
    set_field(L, "name", step.answers[i].name);
    set_field(L, "kind", to_string(step.answers[i].kind));
    set_field(L, "change", step.change[i]);
    set_field(L, "error", step.error[i]);
    end_list_entry(L, i + 1);
  }
}

void set_merge(lua_State* L, const MassSpringModel& model, const lod::Merge& merge,
               std::uint32_t base_nodes) {
  set_field(L, "node", merge.node + 1);
  set_field(L, "pieces", merge.pieces);
  set_field(L, "base_nodes", base_nodes);
  set_field(L, "position", model.rest[merge.node]);
  set_field(L, "material", model.materials[model.material[merge.node]].name);
  set_field(L, "border", model.border[merge.node] != 0);
  set_field(L, "frequencies", merge.frequencies);
  set_field(L, "smooth_loads", merge.smooth_loads);
  set_field(L, "local_loads", merge.local_loads);
  set_field(L, "change", merge.change);
}

void push_merges(lua_State* L, const Level& level, const lod::MergeStep& step) {
  std::vector<std::uint32_t> base_nodes(level.of_base.count, 0);
  for (const std::uint32_t node : level.of_base.of) ++base_nodes[node];
  std::vector<std::uint32_t> order(step.merges.size());
  std::iota(order.begin(), order.end(), 0U);
  std::stable_sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
    return step.merges[a].frequencies > step.merges[b].frequencies;
  });
  push_tables(L, order, [&](std::uint32_t merge) {
    set_merge(L, level.model, step.merges[merge], base_nodes[merge]);
  });
}

int merge_log_binding(Call& call) {
  const auto asset = call.value<ChainValue>(1);
  lod::MergeLogOptions options;
  options.threads = call.session().settings().threads;
  options.progress = call.progress();
  TableReader reader = call.options(2);
  read_options(call, reader, options, &asset->chain.levels.front().model);
  reader.finish();
  const lod::MergeLog log = lod::log_merges(asset->chain, options);
  lua_State* L = call.lua();
  push_tables(L, log.steps, [&](const lod::MergeStep& step) {
    set_field(L, "from", step.from);
    set_field(L, "level", step.level);
    set_field(L, "frequency_error", lod::mean_error(step, lod::Answer::Kind::mode));
    set_field(L, "smooth_load_error", lod::mean_error(step, lod::Answer::Kind::smooth));
    set_field(L, "local_load_error", lod::mean_error(step, lod::Answer::Kind::local));
    push_answers(L, step);
    end_field(L, "answers");
    push_merges(L, asset->chain.levels[step.level], step);
    end_field(L, "merges");
  });
  return 1;
}

void describe_records(Api& api) {
  api.add(RecordEntry{
      .name = "MergeStep",
      .summary = "Changes caused by the merges of one level: an entry of merge_log. Errors and "
                 "changes are natural logarithms of level over base: 0.01 is 1 %.",
      .fields =
          {result_field("from", "integer", "level that was merged: the previous one or 0"),
           result_field("level", "integer", "the resulting level"),
           result_field(
               "frequency_error", "number",
               "mean |error| of the level's lowest frequencies, each relative to the base's "
               "response to the same mode; above f1_10_error where the base has no such mode"),
           result_field("smooth_load_error", "number", "mean |error| of the smooth loads"),
           result_field("local_load_error", "number", "mean |error| of pinches and pushes"),
           result_field(
               "answers", "list of tables",
               "quantities compared: name, kind (mode, smooth, local), change (in this step; of ln "
               "frequency, for loads of ln compliance), error (since the base; of the whole "
               "compliance "
               "of the loaded nodes, where a certificate compares the means of groups)"),
           result_field("merges", "list of MergeEntry",
                        "nodes of the level, those with the largest contribution first")},
      .example = "s.merge_log(chain)[1].merges[1].position"});
  api.add(RecordEntry{
      .name = "MergeEntry",
      .summary = "Contribution of one merge to the errors of a MergeStep.",
      .fields = {result_field("node", "integer", "node of the level that results from it"),
                 result_field("pieces", "integer",
                              "number of nodes merged into it; 1: not merged in this step"),
                 result_field("base_nodes", "integer", "number of base nodes in its group"),
                 result_field("position", "{x, y, z}", "position of the node [m]"),
                 result_field("material", "string", "material of most of its volume"),
                 result_field("border", "boolean", "whether the node lies on the surface"),
                 result_field("frequencies", "number",
                              "contribution to the mean |error| of the frequencies; below 0: the "
                              "merge reduced the error"),
                 result_field("smooth_loads", "number",
                              "contribution to the mean |error| of the smooth loads"),
                 result_field("local_loads", "number",
                              "contribution to the mean |error| of pinches and pushes"),
                 result_field("change", "list of numbers",
                              "contribution to the change of each quantity in this step; the "
                              "contributions of all merges sum to the change")},
      .example = "s.merge_log(chain)[1].merges[1].frequencies"});
}

}  // namespace

void describe_merge_log(Api& api) {
  describe_records(api);
  api.add(FunctionEntry{
      .name = "merge_log",
      .group = "Levels of detail",
      .summary = "Attributes the errors of each level to its merges: changes of the lowest modes "
                 "and of static loads relative to the base, as sums over the nodes.",
      .arguments = {{.name = "chain", .type = "LodChain", .help = "levels and their base"}},
      .options = parameters_of<lod::MergeLogOptions>(),
      .returns = "list of MergeStep, one per level except the base",
      .errors = "A chain without coarser levels; a level without springs; hundreds of mechanisms "
                "in a large component.",
      .example = "local step = s.merge_log(chain)[1]\n"
                 "for i = 1, 5 do\n"
                 "  local merge = step.merges[i]\n"
                 "  print(merge.material, merge.frequencies, table.unpack(merge.position))\n"
                 "end",
      .call = merge_log_binding});
}

}  // namespace springlod::scripting
