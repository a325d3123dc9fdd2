#include "scripting/engine/quantity.hpp"

#include <cmath>

#include <fmt/format.h>
#include <lua.hpp>

#include "base/error.hpp"
#include "scripting/engine/api.hpp"
#include "scripting/engine/value.hpp"

namespace springlod::scripting {

std::string text_at(lua_State* L, int index) {
  std::size_t size = 0;
  const char* text = lua_tolstring(L, index, &size);
  return {text, size};
}

std::string shown(lua_State* L, int index) {
  switch (lua_type(L, index)) {
    case LUA_TSTRING:
      return fmt::format("\"{}\"", text_at(L, index));
    case LUA_TNUMBER:
      return lua_isinteger(L, index) != 0 ? fmt::format("{}", lua_tointeger(L, index))
                                          : fmt::format("{}", lua_tonumber(L, index));
    case LUA_TBOOLEAN:
      return lua_toboolean(L, index) != 0 ? "true" : "false";
    default:
      return describe_type_at(L, index);
  }
}

std::string range_text(const Range& range, Dimension dimension, double value) {
  return fmt::format("from {}, got {}", to_string(range, dimension),
                     format_quantity(value, dimension));
}

double quantity_at(lua_State* L, int index, Dimension dimension, std::string_view what) {
  double value = 0;
  if (lua_type(L, index) == LUA_TSTRING) {
    value = parse_quantity(lua_tostring(L, index), dimension, what);
  } else if (lua_type(L, index) == LUA_TNUMBER) {
    value = lua_tonumber(L, index);
  } else {
    const std::string_view unit = si_unit(dimension);
    throw InputError(fmt::format(
        "{} must be a number{}, got {}", what,
        unit.empty() ? "" : fmt::format(" (in {}) or text with a unit", unit), shown(L, index)));
  }
  if (!std::isfinite(value))
    throw InputError(fmt::format("{} must be finite, got {}", what, value));
  return value;
}

double usual_quantity_at(lua_State* L, int index, Dimension dimension, std::string_view what) {
  const double value = quantity_at(L, index, dimension, what);
  if (!kUsualNumbers.contains(value))
    throw InputError(
        fmt::format("{} must be {}", what, range_text(kUsualNumbers, dimension, value)));
  return value;
}

Vec3 vector_at(lua_State* L, int index, Dimension dimension, std::string_view what) {
  const int table = lua_absindex(L, index);
  if (lua_type(L, table) != LUA_TTABLE || lua_rawlen(L, table) != 3)
    throw InputError(fmt::format("{} must be a list of three numbers {{x, y, z}}, got {}", what,
                                 lua_type(L, table) == LUA_TTABLE
                                     ? fmt::format("a table of {}", lua_rawlen(L, table))
                                     : shown(L, table)));
  Vec3 vector;
  for (int axis = 0; axis < 3; ++axis) {
    lua_rawgeti(L, table, axis + 1);
    vector[axis] = usual_quantity_at(L, -1, dimension, fmt::format("{}[{}]", what, axis + 1));
    lua_pop(L, 1);
  }
  return vector;
}

}  // namespace springlod::scripting
