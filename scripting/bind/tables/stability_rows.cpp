#include "scripting/bind/tables/stability_rows.hpp"

#include <fmt/format.h>
#include <lua.hpp>

#include "scripting/engine/result_table.hpp"

namespace springlod::scripting {

namespace {

/// A point with what it shares with others.
struct Row {
  std::string stiff_part;
  sim::StabilityBody body;
  sim::StabilityPoint point;
};

/// Calls visit(name, member) for each field. `node`: of the point, counted from 1.
template <class Visit>
void each_field(Row& row, std::optional<std::uint32_t>& node, const Visit& visit) {
  visit("stiff_part", row.stiff_part);
  visit("level", row.body.level);
  visit("ratio", row.body.ratio);
  visit("nodes", row.body.nodes);
  visit("springs", row.body.springs);
  visit("period", row.body.period);
  visit("duration", row.body.duration);
  visit("body_limit", row.body.limit);
  visit("limited_by", row.body.limited_by);
  visit("frequency_error", row.body.frequency_error);
  visit("reference_error", row.body.reference_error);
  visit("loose_nodes", row.body.loose_nodes);
  visit("integrator", row.point.integrator);
  visit("iterations", row.point.iterations);
  visit("step", row.point.step);
  visit("limit", row.point.limit);
  visit("stable", row.point.stable);
  visit("finished", row.point.finished);
  visit("verdict", row.point.verdict);
  visit("diverged_at", row.point.diverged_at);
  visit("node", node);
  visit("energy_drift", row.point.energy_drift);
  visit("error", row.point.error);
  visit("cost", row.point.cost);
  visit("unconverged_steps", row.point.unconverged_steps);
  visit("wall_seconds", row.point.wall_seconds);
}

struct Writer {
  lua_State* L;
  template <class T>
  void operator()(const char* name, const T& value) const {
    if constexpr (HasChoices<T>)
      set_field(L, name, to_string(value));
    else
      set_field(L, name, value);
  }
  template <class T>
  void operator()(const char* name, const std::optional<T>& value) const {
    if (value) set_field(L, name, *value);
  }
};

struct Reader {
  TableReader& table;
  template <class T>
  void operator()(const char* name, T& value) const {
    table.read(name, value);
  }
};

Row read_row(TableReader table) {
  Row row;
  std::optional<std::uint32_t> node;
  each_field(row, node, Reader{table});
  table.finish();
  if (node && *node == 0) table.refuse("node", "a number from 1");
  if (node) row.point.node = *node - 1;
  return row;
}

bool is_of(const sim::StabilityBody& body, const Row& row) {
  return body.level == row.body.level && body.ratio == row.body.ratio;
}

}  // namespace

RecordEntry stability_row_entry() {
  const auto field = [](const char* name, const char* type, const char* help) {
    return Parameter{.name = name, .type = type, .fallback = "none", .help = help};
  };
  const auto word = [&](const char* name, const char* help, Words words) {
    Parameter parameter = field(name, "one of", help);
    parameter.choices = std::move(words);
    return parameter;
  };
  return {
      .name = "StabilityRow",
      .summary = "A point of a stability map with all that is known of its level.",
      .fields = {field("stiff_part", "string", "what is stiff"),
                 field("level", "integer", "number of the level"),
                 field("ratio", "number", "of Young's moduli, stiff over soft"),
                 field("nodes", "integer", "number of nodes"),
                 field("springs", "integer", "number of springs"),
                 field("period", "number", "of the slowest mode of the base [s]"),
                 field("duration", "number", "of each run [s]"),
                 field("body_limit", "number", "predicted limit of symplectic Euler [s]"),
                 word("limited_by", "what limits the step", words_of<sim::StepBound>()),
                 field("frequency_error", "number",
                       "mean relative error of the lowest frequencies"),
                 field("reference_error", "number", "of the reference run"),
                 field("loose_nodes", "integer", "number of nodes in mechanisms"),
                 word("integrator", "its name", words_of<sim::Integrator>()),
                 field("iterations", "integer", "at most; 0: explicit"),
                 field("step", "number", "[s]"),
                 field("limit", "number", "predicted for the integrator [s]"),
                 field("stable", "boolean", "completed with less than twice its initial energy"),
                 field("finished", "boolean", "completed: the numbers below are valid"),
                 word("verdict", "on the run", words_of<sim::Verdict>()),
                 field("diverged_at", "number", "[s]"),
                 field("node", "integer", "that diverged or moves in a mechanism, from 1"),
                 field("energy_drift", "number", "of the scheme, relative"),
                 field("error", "number", "against the reference run, relative"),
                 field("cost", "number", "spring updates per simulated second"),
                 field("unconverged_steps", "integer",
                       "steps in which the solver stopped too early"),
                 field("wall_seconds", "number", "measured; not reproducible")},
      .example = "local rows = map:rows()\nprint(rows[1].verdict)",
  };
}

void push_stability_rows(lua_State* L, const sim::StabilityMap& map) {
  push_tables(L, map.points, [&](const sim::StabilityPoint& point) {
    Row row{map.stiff_part, map.bodies[point.body], point};
    std::optional<std::uint32_t> node;
    if (point.node) node = *point.node + 1;
    each_field(row, node, Writer{L});
  });
}

sim::StabilityMap read_stability_rows(Call& call, int argument) {
  lua_State* L = call.lua();
  const int list = call.index(argument);
  if (!lua_istable(L, list)) call.refuse(argument, "a list of StabilityRow");
  sim::StabilityMap map;
  const lua_Integer count = luaL_len(L, list);
  for (lua_Integer i = 1; i <= count; ++i) {
    if (lua_geti(L, list, i) != LUA_TTABLE) call.refuse(argument, "a list of StabilityRow");
    Row row = read_row(
        call.record(lua_gettop(L), "StabilityRow", fmt::format("join_stability: row {}", i)));
    lua_pop(L, 1);
    map.stiff_part = row.stiff_part;
    if (map.bodies.empty() || !is_of(map.bodies.back(), row)) map.bodies.push_back(row.body);
    row.point.body = static_cast<std::uint32_t>(map.bodies.size() - 1);
    map.points.push_back(row.point);
  }
  return map;
}

}  // namespace springlod::scripting
