// Completion at the prompt.

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <system_error>
#include <utility>

#include <fmt/format.h>
#include <lua.hpp>

#include "scripting/engine/call.hpp"
#include "scripting/engine/cursor.hpp"
#include "scripting/engine/help.hpp"
#include "scripting/engine/repl.hpp"
#include "scripting/engine/value.hpp"

namespace springlod::scripting {

namespace {

namespace fs = std::filesystem;
using Names = std::vector<std::string>;

// "s.vox" -> {"s", "vox"}
Names path_of(std::string_view text) {
  Names path{""};
  for (const char c : text) {
    if (c == '.' || c == ':')
      path.emplace_back();
    else
      path.back() += c;
  }
  return path;
}

// The name or path that ends at the cursor.
std::string_view path_before(std::string_view text) {
  std::size_t start = text.size();
  while (start > 0 &&
         (is_name_letter(text[start - 1]) || text[start - 1] == '.' || text[start - 1] == ':'))
    --start;
  return text.substr(start);
}

// Pushes the value of all words of the path but the last; returns false if a word before is no
// table. Raw reads only: completion must not run metamethods of the script.
bool push_owner(lua_State* L, const Names& path) {
  lua_pushglobaltable(L);
  for (std::size_t i = 0; i + 1 < path.size(); ++i) {
    if (!lua_istable(L, -1)) return false;
    push(L, path[i]);
    lua_rawget(L, -2);
  }
  return true;
}

const TypeEntry* type_at(lua_State* L, int index, const Api& api) {
  if (lua_isuserdata(L, index) == 0) return nullptr;
  for (const TypeEntry& type : api.types())
    if (boxed_at(L, index, type.tag)) return &type;
  return nullptr;
}

void add_keys(lua_State* L, int table, Names& names) {
  lua_pushnil(L);
  while (lua_next(L, table) != 0) {
    if (lua_type(L, -2) == LUA_TSTRING) names.emplace_back(lua_tostring(L, -2));
    lua_pop(L, 1);
  }
}

// `separator`: before the last word of the path; values have fields after a dot, and methods after
// a colon.
Names members(lua_State* L, const Names& path, char separator, const Api& api) {
  Names names;
  const int bottom = lua_gettop(L);
  if (push_owner(L, path)) {
    if (lua_istable(L, -1)) add_keys(L, lua_gettop(L), names);
    if (const TypeEntry* type = type_at(L, -1, api)) {
      if (separator == '.')
        for (const FieldEntry& field : type->fields) names.push_back(field.parameter.name);
      else
        for (const FunctionEntry& method : type->methods) names.push_back(method.name);
    }
  }
  lua_settop(L, bottom);
  if (path.size() == 1) names.insert(names.end(), kKeywords.begin(), kKeywords.end());
  return names;
}

// The function of the module or the method that a path names; null if it names another value.
const FunctionEntry* function_named(lua_State* L, const std::string& callee, const Api& api) {
  const Names path = path_of(callee);
  const int bottom = lua_gettop(L);
  const FunctionEntry* entry = nullptr;
  if (push_owner(L, path)) {
    if (lua_istable(L, -1)) {
      push(L, path.back());
      lua_rawget(L, -2);
      entry = entry_of_function(L, -1);
    } else if (const TypeEntry* type = type_at(L, -1, api)) {
      for (const FunctionEntry& method : type->methods)
        if (method.name == path.back()) entry = &method;
    }
  }
  lua_settop(L, bottom);
  return entry;
}

const Parameter* find(const std::vector<Parameter>& parameters, const std::string& name) {
  for (const Parameter& parameter : parameters)
    if (parameter.name == name) return &parameter;
  return nullptr;
}

// The record that a type such as "list of Obstacle" or "table of Material by part" is made of.
const RecordEntry* record_in(const std::string& type, const Api& api) {
  for (const RecordEntry& record : api.records()) {
    const std::size_t at = type.find(record.name);
    if (at == std::string::npos || (at > 0 && is_name_letter(type[at - 1]))) continue;
    const std::size_t end = at + record.name.size();
    if (end == type.size() || !is_name_letter(type[end])) return &record;
  }
  return nullptr;
}

// What the API says of the place of the cursor in its brackets.
struct Place {
  const std::vector<Parameter>* keys = nullptr;  // of the innermost table; null: unknown
  const Parameter* value = nullptr;              // that is typed; null: unknown
};

// The keys of a table that is the value of `parameter`, itself or as an entry of it.
const std::vector<Parameter>* keys_of(const Parameter* parameter, const Api& api) {
  const RecordEntry* record = parameter == nullptr ? nullptr : record_in(parameter->type, api);
  return record == nullptr ? nullptr : &record->fields;
}

Place place_of(lua_State* L, const Cursor& cursor, const Api& api) {
  Place place;
  const FunctionEntry* function = nullptr;
  std::size_t argument = 0;
  for (const OpenBracket& open : cursor.open) {
    if (!open.callee.empty()) {
      function = function_named(L, open.callee, api);
      place = {};
      argument = 0;
    }
    if (open.bracket == '{' && function != nullptr) {
      if (argument < function->arguments.size())
        place.keys = keys_of(&function->arguments[argument], api);
      else
        place.keys = &function->options;
      function = nullptr;
      place.value = nullptr;
    } else if (open.bracket == '{' && place.value != nullptr) {
      // An entry of a list, or of a table by name, is described as the list is.
      place.keys = keys_of(place.value, api);
    } else if (open.bracket == '[') {
      place = {};
    }
    argument = open.commas;
    if (open.bracket == '(' && function != nullptr && argument < function->arguments.size())
      place.value = &function->arguments[argument];
    if (open.bracket == '{' && !open.key.empty() && place.keys != nullptr)
      if (const Parameter* named = find(*place.keys, open.key)) place.value = named;
  }
  return place;
}

// Files and folders that continue a path; folders end in a slash.
Completions files(std::string_view path) {
  const std::size_t slash = path.rfind('/');
  const fs::path folder = slash == std::string_view::npos ? "." : path.substr(0, slash + 1);
  Completions found{
      .typed = std::string(slash == std::string_view::npos ? path : path.substr(slash + 1))};
  std::error_code error;
  for (fs::directory_iterator entry(folder, error), end; !error && entry != end;
       entry.increment(error)) {
    std::string name = entry->path().filename().string();
    if (name.front() == '.' && !found.typed.starts_with('.')) continue;
    std::error_code unreadable;
    if (entry->is_directory(unreadable)) name += '/';
    found.names.push_back(std::move(name));
  }
  return found;
}

Completions in_string(const Cursor& cursor, std::string_view text, const Place& place,
                      const Api& api) {
  const std::string_view typed = text.substr(*cursor.string);
  if (place.value != nullptr && !place.value->choices.empty())
    return {std::string(typed), place.value->choices.names(), std::string(1, cursor.quote)};
  if (!cursor.open.empty() && cursor.open.back().callee == "help")
    return {std::string(typed), help_topics(api), std::string(1, cursor.quote)};
  const bool takes_text =
      place.value == nullptr || place.value->type.find("string") != std::string::npos;
  if (!takes_text || cursor.quote == '[') return {};
  Completions found = files(typed);
  std::erase_if(found.names, [&](const auto& name) { return !name.starts_with(found.typed); });
  // A folder goes on.
  if (found.names.size() == 1 && !found.names.front().ends_with('/')) found.ending = cursor.quote;
  return found;
}

// Keys that the table of options does not have yet.
Names free_keys(const OpenBracket& table, const std::vector<Parameter>& keys) {
  Names names;
  for (const Parameter& key : keys)
    if (std::find(table.keys.begin(), table.keys.end(), key.name) == table.keys.end())
      names.push_back(key.name);
  return names;
}

Names values_of(const Parameter& parameter) {
  Names names;
  if (parameter.type == "boolean") return {"false", "true"};
  for (const std::string& word : parameter.choices.names())
    names.push_back(fmt::format("\"{}\"", word));
  return names;
}

// Sorts, and keeps what continues the typed word.
Completions tidy(Completions found) {
  Names& names = found.names;
  std::erase_if(names, [&](const std::string& name) { return !name.starts_with(found.typed); });
  std::sort(names.begin(), names.end());
  names.erase(std::unique(names.begin(), names.end()), names.end());
  return found;
}

}  // namespace

Completions completions(ScriptState& state, std::string_view before_cursor) {
  lua_State* L = state.lua();
  const Cursor cursor = cursor_in(before_cursor);
  if (cursor.comment) return {};
  const Place place = place_of(L, cursor, state.api());
  if (cursor.string) return tidy(in_string(cursor, before_cursor, place, state.api()));

  const std::string_view path = path_before(before_cursor);
  // Whether the word at the cursor is all of its entry so far.
  bool first = false;
  if (!cursor.open.empty()) {
    const std::string_view entry = before_cursor.substr(cursor.open.back().start);
    first = entry.find_first_not_of(" \t\n") == std::string_view::npos ||
            entry.substr(entry.find_first_not_of(" \t\n")) == path;
  }
  if (first && path.find_first_of(".:") == std::string_view::npos) {
    Completions found{.typed = std::string(path)};
    const OpenBracket& innermost = cursor.open.back();
    if (innermost.bracket == '{' && innermost.key.empty() && place.keys != nullptr) {
      found.names = free_keys(innermost, *place.keys);
      found.ending = " = ";
    } else if (place.value != nullptr) {
      found.names = values_of(*place.value);
    }
    found = tidy(std::move(found));
    if (!found.names.empty()) return found;
  }
  const Names words = path_of(path);
  const std::size_t separator = path.find_last_of(".:");
  const char sign = separator == std::string_view::npos ? ' ' : path[separator];
  const auto found = [&](char after) {
    return tidy({words.back(), members(L, words, after, state.api()), ""});
  };
  Completions members = found(sign);
  // A method that is typed with a dot.
  if (members.names.empty() && sign == '.') {
    members = found(':');
    members.colon = !members.names.empty();
  }
  return members;
}

}  // namespace springlod::scripting
