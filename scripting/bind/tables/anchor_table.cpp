#include "scripting/bind/tables/anchor_table.hpp"

#include <fmt/format.h>
#include <lua.hpp>

#include "base/error.hpp"
#include "model/anchors.hpp"
#include "scripting/bind/tables/node_choice.hpp"
#include "scripting/bind/tables/scenario_table.hpp"

namespace springlod::scripting {

namespace {

sim::AnchorKey read_pose(const Call& call, int table, const std::string& owner) {
  TableReader reader = call.record(table, "Pose", owner);
  sim::AnchorKey key;
  if (!reader.has("time")) reader.refuse("time", "given: seconds after the start of the run");
  reader.read("time", key.time);
  reader.read("move", key.move);
  if (const int given = reader.raw("turn")) {
    const Eigen::AngleAxisd turn = read_turn(call, given, owner + ".turn");
    key.turn = turn.angle() * turn.axis();
  }
  reader.finish();
  return key;
}

void read_path(const Call& call, TableReader& anchor, std::vector<sim::AnchorKey>& into) {
  const int list = anchor.raw("path");
  if (list == 0) return;
  lua_State* L = anchor.lua();
  if (!lua_istable(L, list)) anchor.refuse("path", "a list of Pose tables");
  for (lua_Integer i = 1; i <= static_cast<lua_Integer>(lua_rawlen(L, list)); ++i) {
    lua_rawgeti(L, list, i);
    into.push_back(read_pose(call, lua_gettop(L), fmt::format("{}.path[{}]", anchor.owner(), i)));
    lua_settop(L, list);
  }
}

sim::Anchor read_anchor(const Call& call, int table, const std::string& owner, lua_Integer number,
                        const MassSpringModel& model) {
  TableReader reader = call.record(table, "Anchor", owner);
  sim::Anchor anchor{.name = fmt::format("anchor {}", number), .nodes = {}};
  reader.read("name", anchor.name);
  anchor.nodes = read_nodes(reader, "nodes", model);
  if (anchor.nodes.empty())
    reader.refuse("nodes", "given: a list of node numbers or a function of a node");
  read_path(call, reader, anchor.path);
  if (reader.has("pivot")) {
    anchor.pivot = Vec3::Zero();
    reader.read("pivot", *anchor.pivot);
  }
  if (reader.has("stiffness")) {
    anchor.spring.emplace();
    reader.read("stiffness", anchor.spring->stiffness);
    reader.read("damping", anchor.spring->damping);
  } else if (reader.has("damping")) {
    reader.refuse("stiffness", "given with damping: that of the springs in N/m");
  }
  reader.finish();
  return anchor;
}

bool is_list_of_tables(lua_State* L, int index) {
  if (!lua_istable(L, index)) return false;
  const bool found = lua_rawgeti(L, index, 1) == LUA_TTABLE;
  lua_pop(L, 1);
  return found;
}

}  // namespace

std::vector<sim::Anchor> read_anchors(const Call& call, TableReader& reader,
                                      const MassSpringModel& model) {
  const int given = reader.raw("anchored");
  if (given == 0) return {};
  lua_State* L = reader.lua();
  const std::string owner = reader.owner() + ": anchored";
  if (!is_list_of_tables(L, given)) {
    std::vector<std::uint32_t> nodes = nodes_at(L, given, model, owner);
    if (nodes.empty()) return {};
    return {{.name = "anchor 1", .nodes = std::move(nodes)}};
  }
  std::vector<sim::Anchor> anchors;
  for (lua_Integer i = 1; i <= static_cast<lua_Integer>(lua_rawlen(L, given)); ++i) {
    lua_rawgeti(L, given, i);
    const int table = lua_gettop(L);
    anchors.push_back(read_anchor(call, table, fmt::format("{}[{}]", owner, i), i, model));
    lua_settop(L, table - 1);
  }
  sim::validate(anchors, model);
  return anchors;
}

Parameter anchors_parameter() {
  Parameter parameter = anchored_parameter();
  parameter.help =
      "nodes that are held, of the model or the base of the chain: their numbers, or a function of "
      "a Node that returns true for them, which stay where they are at the start; or a list of "
      "Anchor, which may follow paths";
  return parameter;
}

Support read_anchored(const Call& call, TableReader& reader, const MassSpringModel& model) {
  return sim::support_of(read_anchors(call, reader, model), model);
}

Parameter anchored_parameter() {
  struct AnyOptions {
    Support anchored;
  };
  constexpr auto row = anchored_option(&AnyOptions::anchored);
  return {.name = row.name, .type = kAnchoredType, .fallback = row.fallback, .help = row.help};
}

void push_anchor_loads(lua_State* L, const TrajectoryValue& value) {
  const sim::Trajectory& t = value.trajectory;
  begin_list(L, t.anchor_loads.size());
  for (std::size_t f = 0; f < t.anchor_loads.size(); ++f) {
    begin_list(L, t.anchor_loads[f].size());
    for (std::size_t a = 0; a < t.anchor_loads[f].size(); ++a) {
      const sim::AnchorLoad& load = t.anchor_loads[f][a];
      begin_table(L);
      set_field(L, "name", value.anchor_names[a]);
      set_field(L, "force", load.force);
      set_field(L, "torque", load.torque);
      set_field(L, "work", load.work);
      end_list_entry(L, a + 1);
    }
    end_list_entry(L, f + 1);
  }
}

void describe_anchors(Api& api) {
  api.add(RecordEntry{
      .name = "Pose",
      .summary = "Where an anchor is at one time, relative to the start of the run.",
      .fields = {{.name = "time",
                  .type = "quantity",
                  .dimension = Dimension::time,
                  .range = Range{1e-9, 1e5},
                  .help = "time since the start, at which the anchor is where it started"},
                 {.name = "move",
                  .type = "{x, y, z}",
                  .dimension = Dimension::length,
                  .fallback = "{0, 0, 0}",
                  .help = "displacement since the start"},
                 {.name = "turn",
                  .type = "Turn",
                  .fallback = "none",
                  .help = "rotation since the start about the pivot, which moves too; more than "
                          "360 deg are several turns"}},
      .example = "{time = 0.5, move = {0, 0, \"2 cm\"}, turn = {axis = {1, 0, 0}, angle = "
                 "\"90 deg\"}}"});
  api.add(RecordEntry{
      .name = "Anchor",
      .summary =
          "Nodes that a run holds. They stay where they are at its start, or move as one "
          "rigid body along a path, whatever acts on them; or springs pull them to where they "
          "would be then. Loads and modes take the nodes of an anchor as held in place, or "
          "on these springs.",
      .fields = {{.name = "nodes",
                  .type = "list of integers or function",
                  .help = "their numbers, or a function of a Node that returns true for them"},
                 {.name = "name",
                  .type = "string",
                  .fallback = "\"anchor 1\", ...",
                  .help = "name in messages and results"},
                 {.name = "path",
                  .type = "list of Pose",
                  .fallback = "it stays",
                  .help = "poses in the order of time; the anchor moves smoothly from one to the "
                          "next without overshooting, and rests at the start and at the last"},
                 {.name = "pivot",
                  .type = "{x, y, z}",
                  .dimension = Dimension::length,
                  .fallback = "the centre of mass of its nodes",
                  .help = "point about which it turns, at the start"},
                 {.name = "stiffness",
                  .type = "number",
                  .range = Range{1e-9, 1e9},
                  .fallback = "the nodes are held",
                  .help = "pull the nodes by springs of this stiffness in all, along any direction "
                          "[N/m]; the nodes share it by their masses"},
                 {.name = "damping",
                  .type = "quantity",
                  .dimension = Dimension::time,
                  .range = Range{0, 1e6},
                  .fallback = "0",
                  .help = "damping time of these springs: their dampers have it times the "
                          "stiffness"}},
      .example = "{name = \"jaw\", nodes = function(node) return node.x > 0.09 end,\n"
                 "  path = {{time = 1, move = {0.02, 0, 0}}}}"});
}

}  // namespace springlod::scripting
