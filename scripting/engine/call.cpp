#include "scripting/engine/call.hpp"

#include <algorithm>

#include <fmt/format.h>
#include <lua.hpp>

#include "base/error.hpp"
#include "base/message.hpp"
#include "scripting/engine/quantity.hpp"
#include "scripting/engine/script_error.hpp"
#include "scripting/engine/suggest.hpp"
#include "scripting/engine/unknown_option.hpp"

namespace springlod::scripting {

namespace {

bool has_option(const FunctionEntry& entry, const std::string& option) {
  return std::any_of(entry.options.begin(), entry.options.end(),
                     [&](const Parameter& each) { return each.name == option; });
}

/// The functions that take what `made_by` returns, and the option.
std::vector<const FunctionEntry*> takers(const Api& api, const FunctionEntry& made_by,
                                         const std::string& option) {
  std::vector<const FunctionEntry*> found;
  for (const FunctionEntry& entry : api.functions())
    if (has_option(entry, option) &&
        std::any_of(entry.arguments.begin(), entry.arguments.end(),
                    [&](const Parameter& argument) { return argument.type == made_by.returns; }))
      found.push_back(&entry);
  return found;
}

/// "; it is an option of compare: s.compare(chain, scenario, {anchored = ...})" for an option in
/// the table of a scenario. `called`: the function that reads the table.
std::string place_of_option(const Api& api, const FunctionEntry& called,
                            const std::string& option) {
  const std::vector<const FunctionEntry*> owners =
      has_option(called, option) ? std::vector{&called} : takers(api, called, option);
  if (owners.empty()) return "";
  std::vector<std::string> names;
  for (const FunctionEntry* owner : owners) names.push_back(owner->name);
  std::string words;
  for (const Parameter& argument : owners.front()->arguments) words += argument.name + ", ";
  return fmt::format("; it is an option of {}: s.{}({}{{{} = ...}})", comma_list(names),
                     names.front(), words, option);
}

int dispatch(lua_State* L) {
  return protect(L, [L] {
    const auto* entry = static_cast<const FunctionEntry*>(lua_touserdata(L, lua_upvalueindex(1)));
    Call call(L, *entry);
    try {
      return entry->call(call);
    } catch (const UnknownOption& error) {
      const std::string place = place_of_option(call.session().api(), *entry, error.option());
      if (place.empty()) throw;
      throw InputError(fmt::format("unknown option '{}'{}", error.option(), place));
    }
  });
}

}  // namespace

Call::Call(lua_State* L, const FunctionEntry& entry)
    : lua_(L),
      entry_(entry),
      session_(session_of(L)),
      count_(lua_gettop(L) - (entry.owner.empty() ? 0 : 1)) {
  // Callbacks and nested tables need more than the 20 slots a C function gets by default.
  luaL_checkstack(L, 64, "a call of springlod");
  const int most = static_cast<int>(entry.arguments.size()) + (entry.options.empty() ? 0 : 1);
  if (count_ > most)
    throw InputError(fmt::format("{} takes {}, got {}; try help(\"{}\")", display_name(),
                                 counted(most, "argument"), count_, display_name()));
  lua_settop(L, index(most));  // fills omitted arguments with nil, before a binding pushes values
}

int Call::index(int number) const {
  return number + (entry_.owner.empty() ? 0 : 1);
}
bool Call::has(int number) const {
  return !lua_isnoneornil(lua_, index(number));
}

std::string Call::display_name() const {
  return entry_.owner.empty() ? entry_.name : entry_.owner + ":" + entry_.name;
}

void Call::refuse(int number, const std::string& expected) const {
  const auto position = static_cast<std::size_t>(number) - 1;
  const std::string name =
      position < entry_.arguments.size() ? entry_.arguments[position].name : "options";
  throw InputError(fmt::format("bad argument {} ({}) of {}: expected {}, got {}", number, name,
                               display_name(), expected, shown(lua_, index(number))));
}

void Call::refuse_self() const {
  throw InputError(fmt::format("{} must be called with a colon, as in value:{}(...)",
                               display_name(), entry_.name));
}

std::string Call::text(int number) const {
  if (lua_type(lua_, index(number)) != LUA_TSTRING) refuse(number, "text");
  return text_at(lua_, index(number));
}

std::filesystem::path Call::path(int number) const {
  const std::string name = text(number);
  // The system would take the part before it.
  if (name.find('\0') != std::string::npos) throw InputError("a path must not have a zero byte");
  return name;
}

std::filesystem::path Call::readable(int number) const {
  std::filesystem::path path = this->path(number);
  session_.files().require_readable(path);
  return path;
}

std::filesystem::path Call::writable(int number) const {
  std::filesystem::path path = this->path(number);
  session_.files().require_writable(path);
  return path;
}

long long Call::integer(int number, long long least, long long most) const {
  int exact = 0;
  const lua_Integer value = lua_type(lua_, index(number)) == LUA_TNUMBER
                                ? lua_tointegerx(lua_, index(number), &exact)
                                : 0;
  if (exact == 0 || value < least || value > most)
    refuse(number, fmt::format("a whole number of {} to {}", least, most));
  return value;
}

TableReader Call::options(int number) const {
  return {lua_, has(number) ? index(number) : 0, entry_.options, display_name()};
}

TableReader Call::record(int index, std::string_view record, std::string owner) const {
  return {lua_, index, session_.api().record(record).fields, std::move(owner)};
}

void push_function(lua_State* L, const FunctionEntry& entry) {
  lua_pushlightuserdata(L, const_cast<FunctionEntry*>(&entry));
  lua_pushcclosure(L, dispatch, 1);
}

const FunctionEntry* entry_of_function(lua_State* L, int index) {
  if (lua_tocfunction(L, index) != dispatch) return nullptr;
  const char* name = lua_getupvalue(L, index, 1);
  if (name == nullptr) return nullptr;
  const auto* entry = static_cast<const FunctionEntry*>(lua_touserdata(L, -1));
  lua_pop(L, 1);
  return entry;
}

}  // namespace springlod::scripting
