#include "scripting/engine/inspect.hpp"

#include <algorithm>
#include <cctype>
#include <vector>

#include <fmt/format.h>
#include <lua.hpp>

#include "scripting/engine/script_error.hpp"
#include "scripting/engine/value.hpp"

namespace springlod::scripting {

namespace {

bool is_name(const std::string& text) {
  if (text.empty() || std::isdigit(static_cast<unsigned char>(text[0])) != 0) return false;
  return std::all_of(text.begin(), text.end(),
                     [](unsigned char c) { return std::isalnum(c) != 0 || c == '_'; });
}

std::string quoted(const std::string& text) {
  std::string result = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') result += '\\';
    if (c == '\n') {
      result += "\\n";
    } else {
      result += c;
    }
  }
  return result + '"';
}

// __tostring of the tables of print_inspected.
int inspected(lua_State* L) {
  return protect(L, [L] {
    push(L, inspect(L, 1));
    return 1;
  });
}

class Inspector {
 public:
  Inspector(lua_State* L, const InspectOptions& options) : lua_(L), options_(options) {}

  std::string show(int index, int depth, bool nested) {
    index = lua_absindex(lua_, index);
    if (lua_type(lua_, index) == LUA_TSTRING) {
      const std::string text = lua_tostring(lua_, index);
      return nested ? quoted(text) : text;
    }
    if (lua_istable(lua_, index) && !has_text(index)) return table(index, depth);
    std::string text = luaL_tolstring(lua_, index, nullptr);
    lua_pop(lua_, 1);
    return text;
  }

 private:
  // Whether a table has a text of its own, by which tostring shows it.
  bool has_text(int index) {
    if (luaL_getmetafield(lua_, index, "__tostring") == LUA_TNIL) return false;
    const bool own = lua_tocfunction(lua_, -1) != inspected;
    lua_pop(lua_, 1);
    return own;
  }

  struct Entry {
    bool by_number = false;
    double number = 0;
    std::string key;
    std::string text;
  };

  std::string table(int index, int depth) {
    const void* identity = lua_topointer(lua_, index);
    if (depth >= options_.depth || std::count(open_.begin(), open_.end(), identity) > 0)
      return "{...}";
    luaL_checkstack(lua_, 8, "inspect");
    open_.push_back(identity);
    std::vector<Entry> entries = collect(index, depth);
    open_.pop_back();
    return layout(entries, depth);
  }

  std::vector<Entry> collect(int index, int depth) {
    const auto length = static_cast<lua_Integer>(lua_rawlen(lua_, index));
    std::vector<Entry> entries;
    lua_Integer hidden = 0;
    for (lua_Integer i = 1; i <= length; ++i) {
      if (i > options_.entries) {
        hidden = length - options_.entries;
        break;
      }
      lua_rawgeti(lua_, index, i);
      entries.push_back({true, static_cast<double>(i), "", show(-1, depth + 1, true)});
      lua_pop(lua_, 1);
    }
    std::vector<Entry> named;
    lua_pushnil(lua_);
    while (lua_next(lua_, index) != 0) {
      const bool listed = lua_isinteger(lua_, -2) != 0 && lua_tointeger(lua_, -2) >= 1 &&
                          lua_tointeger(lua_, -2) <= length;
      if (!listed) named.push_back(keyed(depth));
      lua_pop(lua_, 1);
    }
    std::sort(named.begin(), named.end(), [](const Entry& a, const Entry& b) {
      if (a.by_number != b.by_number) return a.by_number;
      return a.by_number ? a.number < b.number : a.key < b.key;
    });
    if (static_cast<int>(named.size()) > options_.entries) {
      hidden += static_cast<lua_Integer>(named.size()) - options_.entries;
      named.resize(static_cast<std::size_t>(options_.entries));
    }
    entries.insert(entries.end(), named.begin(), named.end());
    if (hidden > 0) entries.push_back({false, 0, "", fmt::format("... {} more", hidden)});
    return entries;
  }

  // The entry for the key and value on top of the stack.
  Entry keyed(int depth) {
    Entry entry;
    entry.by_number = lua_type(lua_, -2) == LUA_TNUMBER;
    if (entry.by_number) entry.number = lua_tonumber(lua_, -2);
    const std::string key = show(-2, depth + 1, false);
    entry.key = lua_type(lua_, -2) == LUA_TSTRING && is_name(key)
                    ? key
                    : fmt::format("[{}]", show(-2, depth + 1, true));
    entry.text = show(-1, depth + 1, true);
    return entry;
  }

  std::string layout(const std::vector<Entry>& entries, int depth) const {
    if (entries.empty()) return "{}";
    std::vector<std::string> parts;
    std::size_t width = static_cast<std::size_t>(2 * depth) + 4;
    bool lines = false;
    for (const Entry& entry : entries) {
      parts.push_back(entry.key.empty() ? entry.text : entry.key + " = " + entry.text);
      width += parts.back().size() + 2;
      lines = lines || parts.back().find('\n') != std::string::npos;
    }
    if (!lines && width <= static_cast<std::size_t>(options_.line_width))
      return fmt::format("{{{}}}", fmt::join(parts, ", "));
    const std::string indent(static_cast<std::size_t>(2 * depth) + 2, ' ');
    std::string text = "{\n";
    for (const std::string& part : parts) text += indent + part + ",\n";
    return text + std::string(static_cast<std::size_t>(2 * depth), ' ') + "}";
  }

  lua_State* lua_;
  InspectOptions options_;
  std::vector<const void*> open_;  // tables being shown, to detect cycles
};

}  // namespace

std::string inspect(lua_State* L, int index, const InspectOptions& options) {
  return Inspector(L, options).show(index, 0, false);
}

void print_inspected(lua_State* L) {
  if (luaL_newmetatable(L, "springlod.inspected") != 0) {
    lua_pushcfunction(L, inspected);
    lua_setfield(L, -2, "__tostring");
  }
  lua_setmetatable(L, -2);
}

}  // namespace springlod::scripting
