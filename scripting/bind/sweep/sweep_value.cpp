#include "scripting/bind/sweep/sweep_value.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <lua.hpp>

#include "base/error.hpp"
#include "scripting/engine/script_error.hpp"
#include "scripting/engine/session.hpp"
#include "scripting/engine/suggest.hpp"

namespace springlod::scripting {

namespace {

using sweep::Cell;
using sweep::Row;

/// The message of the error on top. An address, as of a table, would differ from run to run.
std::string message_at_top(lua_State* L) {
  const bool has_text = lua_isstring(L, -1) != 0 || luaL_callmeta(L, -1, "__tostring") != 0;
  if (has_text) return luaL_tolstring(L, -1, nullptr);
  return fmt::format("error with {}, not with a message", describe_type_at(L, lua_gettop(L)));
}

/// Calls the function below its `arguments`; its result is then on the stack.
void call(lua_State* L, int arguments) {
  const int bottom = lua_gettop(L) - arguments - 1;
  if (lua_pcall(L, arguments, 1, 0) == LUA_OK) return;
  const auto error = std::static_pointer_cast<const ErrorValue>(
      boxed_at(L, lua_gettop(L), &kValueName<ErrorValue>));
  const bool interrupted = error && error->kind == "interrupted";
  const std::string message = message_at_top(L);
  lua_settop(L, bottom);
  if (interrupted) throw InterruptedError();
  throw InputError(message);
}

void call_with_point(lua_State* L, FunctionReference function, const SweepUnit& unit) {
  lua_rawgeti(L, LUA_REGISTRYINDEX, function);
  push_point(L, unit);
  call(L, 1);
}

void push_cell(lua_State* L, const Cell& cell) {
  std::visit(
      [L](const auto& value) {
        if constexpr (std::is_same_v<std::decay_t<decltype(value)>, std::monostate>)
          lua_pushnil(L);
        else
          push(L, value);
      },
      cell);
}

/// The value on top, which it pops.
Cell pop_cell(lua_State* L, const std::string& column) {
  Cell cell;
  switch (lua_type(L, -1)) {
    case LUA_TNIL:
      break;
    case LUA_TBOOLEAN:
      cell = lua_toboolean(L, -1) != 0;
      break;
    case LUA_TNUMBER:
      if (lua_isinteger(L, -1) != 0)
        cell = static_cast<std::int64_t>(lua_tointeger(L, -1));
      else
        cell = lua_tonumber(L, -1);
      break;
    case LUA_TSTRING: {
      std::size_t size = 0;
      const char* text = lua_tolstring(L, -1, &size);
      cell = std::string(text, size);
      break;
    }
    default:
      throw InputError(
          fmt::format("unit: column '{}' is {}; a number, a text or a boolean can be "
                      "kept",
                      column, describe_type_at(L, -1)));
  }
  lua_pop(L, 1);
  return cell;
}

/// Throws InputError if the table on top has a key that is no column.
void check_columns(lua_State* L, const std::vector<std::string>& columns) {
  lua_pushnil(L);
  while (lua_next(L, -2) != 0) {
    lua_pop(L, 1);
    const bool known =
        lua_type(L, -1) == LUA_TSTRING &&
        std::find(columns.begin(), columns.end(), lua_tostring(L, -1)) != columns.end();
    if (known) continue;
    lua_pushvalue(L, -1);
    throw InputError(fmt::format("unit: its row has '{}', which is none of the columns ({})",
                                 luaL_tolstring(L, -1, nullptr), fmt::join(columns, ", ")));
  }
}

/// The row in the table on top.
Row row_at_top(lua_State* L, const std::vector<std::string>& columns) {
  check_columns(L, columns);
  Row row;
  for (const std::string& column : columns) {
    lua_getfield(L, -1, column.c_str());
    row.push_back(pop_cell(L, column));
  }
  return row;
}

}  // namespace

std::uint64_t SweepValue::unit_count() const {
  std::uint64_t count = 0;
  for (const SweepStage& stage : stages) count += stage.units;
  return count;
}

SweepPlace place_of(const SweepValue& sweep, std::uint64_t unit) {
  std::size_t stage = 0;
  while (unit >= sweep.stages[stage].units) unit -= sweep.stages[stage++].units;
  return {sweep.stages[stage], unit};
}

void set_axes(lua_State* L, const SweepPlace& place) {
  const std::vector<SweepAxis>& axes = place.stage.axes;
  std::uint64_t rest = place.number;
  for (std::size_t i = axes.size(); i-- > 0;) {
    const std::uint64_t count = axes[i].values.size();
    push_cell(L, axes[i].values[rest % count]);
    end_field(L, axes[i].name.c_str());
    rest /= count;
  }
}

void set_cells(lua_State* L, const std::vector<std::string>& columns, const Row& row) {
  for (std::size_t i = 0; i < columns.size(); ++i) {
    push_cell(L, row[i]);
    end_field(L, columns[i].c_str());
  }
}

void push_point(lua_State* L, const SweepUnit& unit) {
  const SweepPlace place = place_of(unit.sweep, unit.number);
  begin_table(L);
  set_axes(L, place);
  set_field(L, "index", place.number + 1);
  set_field(L, "seed", session_of(L).settings().seed + place.number);
  if (!unit.folder.empty()) set_field(L, "folder", unit.folder);
}

std::vector<Row> run_unit(lua_State* L, const SweepUnit& unit) {
  const SweepStage& stage = place_of(unit.sweep, unit.number).stage;
  const int bottom = lua_gettop(L);
  call_with_point(L, stage.unit, unit);
  if (!lua_istable(L, -1))
    throw InputError(
        fmt::format("unit: it must return a row, a table with the columns {}, or a "
                    "list of rows; it returned {}",
                    fmt::join(stage.columns, ", "), describe_type_at(L, -1)));
  std::vector<Row> rows;
  const lua_Integer count = luaL_len(L, -1);
  lua_pushnil(L);
  const bool empty = lua_next(L, -2) == 0;
  if (!empty) lua_pop(L, 2);
  if (count == 0 && !empty) rows.push_back(row_at_top(L, stage.columns));
  for (lua_Integer i = 1; i <= count; ++i) {
    if (lua_geti(L, -1, i) != LUA_TTABLE)
      throw InputError(
          fmt::format("unit: entry {} of its list is {}, not a row", i, describe_type_at(L, -1)));
    rows.push_back(row_at_top(L, stage.columns));
    lua_pop(L, 1);
  }
  lua_settop(L, bottom);
  return rows;
}

double cost_of(lua_State* L, const SweepUnit& unit) {
  const SweepStage& stage = place_of(unit.sweep, unit.number).stage;
  if (stage.cost == 0) return 1;
  call_with_point(L, stage.cost, unit);
  const double cost = lua_type(L, -1) == LUA_TNUMBER ? lua_tonumber(L, -1) : -1;
  if (!(cost >= 0) || !std::isfinite(cost))
    throw InputError(
        fmt::format("cost: it must return the spring updates of a unit, a number of "
                    "at least 0; for unit {} it returned {}",
                    unit.number + 1, luaL_tolstring(L, -1, nullptr)));
  lua_pop(L, 1);
  return cost;
}

}  // namespace springlod::scripting
