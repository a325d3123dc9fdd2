#include "scripting/bind/tables/options.hpp"

#include <algorithm>
#include <stdexcept>

#include <lua.hpp>

namespace springlod::scripting {

namespace option_detail {

int list_length(TableReader& reader, const char* name, const char* record, int index) {
  if (!lua_istable(reader.lua(), index))
    reader.refuse(name, fmt::format("a list of {} tables", record));
  return static_cast<int>(lua_rawlen(reader.lua(), index));
}

int push_element(lua_State* L, int list, int number) {
  lua_rawgeti(L, list, number);
  return lua_gettop(L);
}

void pop_from(lua_State* L, int index) {
  lua_settop(L, index - 1);
}

}  // namespace option_detail

Parameter& find_parameter(std::vector<Parameter>& parameters, std::string_view name) {
  const auto found =
      std::find_if(parameters.begin(), parameters.end(),
                   [&](const Parameter& parameter) { return parameter.name == name; });
  if (found == parameters.end()) throw std::logic_error(fmt::format("there is no row '{}'", name));
  return *found;
}

void use_session_defaults(std::vector<Parameter>& parameters) {
  for (Parameter& parameter : parameters)
    if (parameter.name == "seed" || parameter.name == "threads")
      parameter.fallback = "s." + parameter.name;
}

}  // namespace springlod::scripting
