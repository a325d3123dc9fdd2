#include "scripting/bind/tables/comparisons.hpp"

#include <lua.hpp>

namespace springlod::scripting {

std::vector<std::shared_ptr<const ComparisonValue>> comparisons_at(Call& call, int number,
                                                                   const std::string& rule) {
  if (auto one = call.try_value<ComparisonValue>(number)) return {std::move(one)};
  lua_State* L = call.lua();
  if (!lua_istable(L, call.index(number))) call.refuse(number, rule);
  std::vector<std::shared_ptr<const ComparisonValue>> all;
  for (lua_Integer i = 1; i <= static_cast<lua_Integer>(lua_rawlen(L, call.index(number))); ++i) {
    lua_rawgeti(L, call.index(number), i);
    all.push_back(std::static_pointer_cast<const ComparisonValue>(
        boxed_at(L, lua_gettop(L), &kValueName<ComparisonValue>)));
    lua_pop(L, 1);
    if (!all.back()) call.refuse(number, rule);
  }
  if (all.empty()) call.refuse(number, rule);
  return all;
}

}  // namespace springlod::scripting
