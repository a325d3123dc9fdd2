#include "scripting/bind/tables/value_list.hpp"

#include <fmt/format.h>
#include <lua.hpp>

namespace springlod::scripting::value_list_detail {

std::vector<std::shared_ptr<const void>> boxed_values_at(Call& call, int number, TypeTag tag,
                                                         const std::string& rule) {
  lua_State* L = call.lua();
  const int index = call.index(number);
  if (auto one = boxed_at(L, index, tag)) return {std::move(one)};
  if (!lua_istable(L, index)) call.refuse(number, rule);
  std::vector<std::shared_ptr<const void>> all;
  for (lua_Integer i = 1; i <= static_cast<lua_Integer>(lua_rawlen(L, index)); ++i) {
    lua_rawgeti(L, index, i);
    all.push_back(boxed_at(L, lua_gettop(L), tag));
    if (!all.back())
      call.refuse(number, fmt::format("{} (entry {} is {})", rule, i, describe_type_at(L, -1)));
    lua_pop(L, 1);
  }
  if (all.empty()) call.refuse(number, rule + " (this one is empty)");
  return all;
}

bool begins_with(Call& call, int number, TypeTag tag) {
  lua_State* L = call.lua();
  const int index = call.index(number);
  if (boxed_at(L, index, tag)) return true;
  if (!lua_istable(L, index)) return false;
  lua_rawgeti(L, index, 1);
  const bool begins = boxed_at(L, lua_gettop(L), tag) != nullptr;
  lua_pop(L, 1);
  return begins;
}

}  // namespace springlod::scripting::value_list_detail
