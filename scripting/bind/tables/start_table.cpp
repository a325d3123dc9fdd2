#include "scripting/bind/tables/start_table.hpp"

#include <string>
#include <vector>

#include <fmt/format.h>
#include <lua.hpp>

#include "base/error.hpp"
#include "scripting/engine/quantity.hpp"

namespace springlod::scripting {

namespace {

// One {x, y, z} per node.
void read_points(TableReader& state, const char* name, Dimension dimension,
                 std::vector<Vec3>& points) {
  const int list = state.raw(name);
  if (list == 0) return;
  lua_State* L = state.lua();
  const std::size_t count = lua_istable(L, list) ? lua_rawlen(L, list) : 0;
  if (count != points.size())
    throw InputError(
        fmt::format("{}.{} must be a list of {} points {{x, y, z}}, one per node, got {}",
                    state.owner(), name, points.size(),
                    lua_istable(L, list) ? fmt::format("{}", count) : describe_type_at(L, list)));
  for (std::size_t i = 0; i < count; ++i) {
    lua_rawgeti(L, list, static_cast<lua_Integer>(i) + 1);
    points[i] = vector_at(L, -1, dimension, fmt::format("{}.{}[{}]", state.owner(), name, i + 1));
    lua_pop(L, 1);
  }
}

}  // namespace

std::optional<State> read_start(Call& call, TableReader& options, const MassSpringModel& model) {
  const int table = options.raw("start");
  if (table == 0) return std::nullopt;
  return state_at(call, table, options.owner() + ": start", model);
}

State state_at(Call& call, int index, const std::string& owner, const MassSpringModel& model) {
  TableReader reader = call.record(index, "State", owner);
  State state{.x = model.rest, .v = std::vector<Vec3>(model.node_count(), Vec3::Zero()), .t = 0};
  reader.has("time");
  read_points(reader, "x", Dimension::length, state.x);
  read_points(reader, "v", Dimension::velocity, state.v);
  reader.finish();
  return state;
}

Parameter start_parameter() {
  return {.name = "start",
          .type = "State",
          .fallback = "the scenario's throw",
          .help =
              "initial position and velocity of every node; the final state of a run continues "
              "that run"};
}

void describe_start(Api& api) {
  api.add(RecordEntry{
      .name = "State",
      .summary = "Positions and velocities of all nodes: the type of trajectory.final and "
                 "of the option start of run.",
      .fields = {{.name = "x",
                  .type = "list of {x, y, z}",
                  .dimension = Dimension::length,
                  .fallback = "the positions in the model",
                  .help = "positions by node"},
                 {.name = "v",
                  .type = "list of {x, y, z}",
                  .dimension = Dimension::velocity,
                  .fallback = "at rest",
                  .help = "velocities by node"},
                 {.name = "time",
                  .type = "number",
                  .fallback = "0",
                  .help = "time of a final state [s]; ignored by runs, which begin at 0"}},
      .example = "start = trajectory.final"});
}

}  // namespace springlod::scripting
