#include "scripting/engine/prompt_words.hpp"

#include <algorithm>
#include <cctype>
#include <sstream>
#include <vector>

#include <fmt/format.h>
#include <lua.hpp>

#include "base/message.hpp"
#include "scripting/engine/cursor.hpp"
#include "scripting/engine/help.hpp"
#include "scripting/engine/paths.hpp"
#include "scripting/engine/suggest.hpp"

namespace springlod::scripting {

namespace {

bool is_space(char c) {
  return std::isspace(static_cast<unsigned char>(c)) != 0;
}

std::string_view trimmed(std::string_view text) {
  while (!text.empty() && is_space(text.back())) text.remove_suffix(1);
  while (!text.empty() && is_space(text.front())) text.remove_prefix(1);
  return text;
}

std::vector<std::string> words_of(std::string_view line) {
  std::istringstream stream{std::string(line)};
  std::vector<std::string> words;
  for (std::string word; stream >> word;) words.push_back(word);
  return words;
}

// The Lua type of a global.
int type_of_global(lua_State* L, std::string_view name) {
  lua_pushglobaltable(L);
  lua_pushlstring(L, name.data(), name.size());
  const int type = lua_rawget(L, -2);
  lua_pop(L, 2);
  return type;
}

bool is_unused(lua_State* L, std::string_view name) {
  return type_of_global(L, name) == LUA_TNIL;
}

bool is_lua(lua_State* L, std::string_view line) {
  const int bottom = lua_gettop(L);
  const std::string expression = "return " + std::string(line);
  const bool loads =
      luaL_loadbufferx(L, expression.data(), expression.size(), "=input", "t") == LUA_OK ||
      luaL_loadbufferx(L, line.data(), line.size(), "=input", "t") == LUA_OK;
  lua_settop(L, bottom);
  return loads;
}

bool is_command(const std::string& name) {
  if (name == "run") return true;
  const std::vector<StockCommand> commands = stock_commands();
  return std::any_of(commands.begin(), commands.end(),
                     [&](const StockCommand& command) { return command.name == name; });
}

// Whether a line of these words, which begins with an unused name, is no sensible Lua: the name
// alone, a flag after it, or a syntax error.
bool reads_as_command(lua_State* L, const std::vector<std::string>& words, std::string_view line) {
  return words.size() == 1 || words[1].starts_with("-") || !is_lua(L, line);
}

// The first of the arguments of a command that looks like a file, or `other`.
std::string file_of(const std::vector<std::string>& arguments, const std::string& other) {
  for (const std::string& word : arguments)
    if (!word.starts_with("-") && word.find('.') != std::string::npos) return printable(word);
  return other;
}

// What does the same in Lua; "" if nothing does. `arguments`: the command and what follows it.
std::string in_lua(const Api& api, const std::string& name,
                   const std::vector<std::string>& arguments) {
  if (name == "help") {
    const bool known = arguments.size() > 1 && api.find_function(arguments[1]) != nullptr;
    return known ? fmt::format("help(\"{}\")", arguments[1]) : "help()";
  }
  if (name == "run") return fmt::format("dofile(\"{}\")", file_of(arguments, "script.lua"));
  if (name == "info") {
    const std::string file = file_of(arguments, "x.glb");
    return fmt::format("{}(\"{}\")", file.ends_with(".glb") ? "s.load" : "s.import", file);
  }
  if (name == "convert")
    return "s.import, s.voxelize, s.lattice, s.simplify and s.save; help(s.import) has an example";
  if (api.find_function(name)) return fmt::format("s.{0}; help(s.{0}) has an example", name);
  return "";
}

// The name at the start of the text; "" if there is none.
std::string_view leading_name(std::string_view text) {
  std::size_t end = 0;
  while (end < text.size() && is_name_letter(text[end])) ++end;
  const bool number = end > 0 && std::isdigit(static_cast<unsigned char>(text[0])) != 0;
  return text.substr(0, number ? 0 : end);
}

bool is_path_letter(char c) {
  return is_name_letter(c) || c == '.' || c == ':';
}

// Drops `start` and the white space after it; returns false if the text begins otherwise.
bool skip(std::string_view& text, std::string_view start) {
  if (!text.starts_with(start)) return false;
  text = trimmed(text.substr(start.size()));
  return true;
}

// "base.nodes" of the line `help(base.nodes)`; "" for any other line.
std::string_view help_argument(lua_State* L, std::string_view line) {
  std::string_view rest = trimmed(line);
  if (type_of_global(L, "help") != LUA_TFUNCTION || !skip(rest, "help") || !skip(rest, "(") ||
      !rest.ends_with(')'))
    return "";
  rest = trimmed(rest.substr(0, rest.size() - 1));
  return std::all_of(rest.begin(), rest.end(), is_path_letter) ? rest : "";
}

}  // namespace

bool asks_to_leave(ScriptState& state, std::string_view line) {
  line = trimmed(line);
  if (line.ends_with(';')) line.remove_suffix(1);
  line = trimmed(line);
  if (line.ends_with("()")) line.remove_suffix(2);
  line = trimmed(line);
  return (line == "exit" || line == "quit") && is_unused(state.lua(), line);
}

std::string chunk_of(ScriptState& state, std::string_view line) {
  // The value of a constant such as s.seed is a plain number or text.
  const std::string_view argument = help_argument(state.lua(), line);
  for (const ConstantEntry& constant : state.api().constants())
    if (argument == "s." + constant.parameter.name) return fmt::format("help(\"{}\")", argument);
  const std::vector<std::string> words = words_of(line);
  const bool is_help = !words.empty() && words.size() <= 2 && words.front() == "help" &&
                       type_of_global(state.lua(), "help") == LUA_TFUNCTION;
  if (!is_help) return std::string(line);
  if (words.size() == 1) return "help()";
  const std::string& topic = words[1];
  if (!std::all_of(topic.begin(), topic.end(), is_path_letter)) return std::string(line);
  return fmt::format("help(\"{}\")", topic);
}

std::string shell_command_answer(ScriptState& state, std::string_view line) {
  line = trimmed(line);
  std::vector<std::string> words = words_of(line);
  if (!words.empty() && words.front() == "$") words.erase(words.begin());
  if (words.empty()) return "";
  lua_State* L = state.lua();
  const bool named = words.front() == "springlod" || words.front().ends_with("/springlod");
  if (!named && !is_command(words.front())) return "";
  if (!is_unused(L, words.front()) || !reads_as_command(L, words, line)) return "";
  std::string typed = printable(fmt::format("{}", fmt::join(words, " ")));
  if (named) words.erase(words.begin());
  const std::string name = words.empty() ? "" : words.front();
  if (!named) typed = "springlod " + typed;
  std::string answer = fmt::format(
      "this is a command for the shell, and the prompt takes Lua; to run it, leave with exit and "
      "type: {}",
      typed);
  const std::string lua = words.empty() ? "" : in_lua(state.api(), name, words);
  if (!lua.empty()) answer += "\nhere, in Lua: " + lua;
  return answer;
}

std::string unknown_topic_answer(ScriptState& state, std::string_view line) {
  const std::string name(help_argument(state.lua(), line));
  if (name.empty() || leading_name(name) != name) return "";
  const bool keyword = std::find(kKeywords.begin(), kKeywords.end(), name) != kKeywords.end();
  if (keyword || !is_unused(state.lua(), name)) return "";
  const std::string near = nearest_name(name, help_topics(state.api()));
  return fmt::format("{} is nil: there is no such variable; {}", name,
                     near.empty() ? "help() lists all functions and values"
                                  : fmt::format("did you mean help(\"{}\")?", near));
}

std::string lost_local_hint(ScriptState& state, std::string_view chunk) {
  std::string_view rest = trimmed(chunk);
  if (leading_name(rest) != "local") return "";
  skip(rest, "local");
  const bool function = leading_name(rest) == "function";
  if (function) skip(rest, "function");
  std::vector<std::string> names;
  do {
    names.emplace_back(leading_name(rest));
    skip(rest, names.back());
    if (rest.starts_with('<'))
      rest = trimmed(rest.substr(std::min(rest.find('>'), rest.size() - 1) + 1));
  } while (skip(rest, ","));
  if (!function && !skip(rest, "=") && !rest.empty() && rest != ";") return "";
  // The values, and nothing else, can be returned.
  const std::string values = (function ? "function" : "") + std::string(rest);
  if (!is_lua(state.lua(), "return " + values) || names == std::vector<std::string>{"s"}) return "";
  return fmt::format(
      "note: at the prompt a local variable lasts for its line only; leave out \"local\" to use {} "
      "in later lines",
      fmt::join(names, ", "));
}

std::string missing_table_hint(ScriptState& state, std::string_view error) {
  constexpr std::string_view kCall = "attempt to call a nil value (global '";
  error = error.substr(0, error.find('\n'));
  const std::size_t at = error.find(kCall);
  if (at == std::string_view::npos) return "";
  const std::string_view rest = error.substr(at + kCall.size());
  const std::string name(rest.substr(0, rest.find('\'')));
  return state.api().find_function(name) ? fmt::format("did you mean s.{}?", name) : "";
}

}  // namespace springlod::scripting
