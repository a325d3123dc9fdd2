// Name completion at the prompt.

#include <algorithm>
#include <array>
#include <cctype>

#include <lua.hpp>

#include "scripting/engine/repl.hpp"
#include "scripting/engine/value.hpp"

namespace springlod::scripting {

namespace {

constexpr std::array<const char*, 22> kKeywords{
    "and",      "break",  "do",   "else", "elseif", "end",  "false", "for",
    "function", "goto",   "if",   "in",   "local",  "nil",  "not",   "or",
    "repeat",   "return", "then", "true", "until",  "while"};

bool is_name_letter(char c) {
  return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_';
}

// "print(s.vox" -> {"s", "vox"}: the path before the cursor; its last word is to be completed.
std::vector<std::string> path_before(std::string_view text) {
  std::size_t start = text.size();
  while (start > 0 &&
         (is_name_letter(text[start - 1]) || text[start - 1] == '.' || text[start - 1] == ':'))
    --start;
  std::vector<std::string> path{""};
  for (const char c : text.substr(start)) {
    if (c == '.' || c == ':') {
      path.emplace_back();
    } else {
      path.back() += c;
    }
  }
  return path;
}

void add_keys(lua_State* L, int table, std::vector<std::string>& names) {
  lua_pushnil(L);
  while (lua_next(L, table) != 0) {
    if (lua_type(L, -2) == LUA_TSTRING) names.emplace_back(lua_tostring(L, -2));
    lua_pop(L, 1);
  }
}

void add_members(lua_State* L, int value, const Api& api, std::vector<std::string>& names) {
  for (const TypeEntry& type : api.types()) {
    if (!boxed_at(L, value, type.tag)) continue;
    for (const FieldEntry& field : type.fields) names.push_back(field.parameter.name);
    for (const FunctionEntry& method : type.methods) names.push_back(method.name);
  }
}

}  // namespace

std::vector<std::string> completions(ScriptState& state, std::string_view before_cursor) {
  lua_State* L = state.lua();
  const int bottom = lua_gettop(L);
  const std::vector<std::string> path = path_before(before_cursor);
  std::vector<std::string> names;
  // Raw reads only: completion must not run metamethods of the script.
  lua_pushglobaltable(L);
  bool found = true;
  for (std::size_t i = 0; found && i + 1 < path.size(); ++i) {
    found = lua_istable(L, -1);
    if (!found) break;
    push(L, path[i]);
    lua_rawget(L, -2);
  }
  if (found && lua_istable(L, -1)) add_keys(L, lua_gettop(L), names);
  if (found && lua_isuserdata(L, -1) != 0) add_members(L, lua_gettop(L), state.api(), names);
  if (path.size() == 1) names.insert(names.end(), kKeywords.begin(), kKeywords.end());
  lua_settop(L, bottom);

  const std::string& word = path.back();
  std::erase_if(names, [&](const std::string& name) { return !name.starts_with(word); });
  std::sort(names.begin(), names.end());
  names.erase(std::unique(names.begin(), names.end()), names.end());
  return names;
}

}  // namespace springlod::scripting
