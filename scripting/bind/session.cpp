// General functions: help, messages, files, JSON.

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <map>
#include <set>
#include <system_error>
#include <utility>

#include <fmt/format.h>
#include <lua.hpp>
#include <nlohmann/json.hpp>

#include "base/error.hpp"
#include "scripting/bind/topics.hpp"
#include "scripting/engine/call.hpp"
#include "scripting/engine/help.hpp"
#include "scripting/engine/inspect.hpp"
#include "scripting/engine/paths.hpp"
#include "scripting/engine/quantity.hpp"
#include "scripting/engine/screen.hpp"
#include "scripting/engine/suggest.hpp"

namespace springlod::scripting {

namespace {

namespace fs = std::filesystem;
using nlohmann::ordered_json;

constexpr const char* kGroup = "Session";
// Depth limit, which stops at tables that contain themselves.
constexpr int kJsonDepth = 64;
// Limit of the number of values: tables that several others contain grow exponentially with depth.
constexpr std::size_t kJsonValues = 2'000'000;

int help(Call& call) {
  if (call.gives(1) && !call.has(1))
    throw InputError("help: the value is nil, perhaps of a misspelt name; help() lists all names");
  const Api& api = call.session().api();
  // Narrower than this, the names in the left column leave no room for a text.
  constexpr std::size_t kNarrowest = 40;
  const std::size_t columns = screen_size().columns;
  const std::size_t width = columns == 0 ? kHelpWidth : std::clamp(columns, kNarrowest, kHelpWidth);
  show_text(call.has(1) ? help_at(call.lua(), call.index(1), api, width) : overview(api, width));
  return 0;
}

int markdown(Call& call) {
  return call.give(api_markdown(call.session().api()));
}

int say(Call& call) {
  call.session().console().print(call.text(1));
  return 0;
}

int use_flags(Call& call) {
  lua_State* L = call.lua();
  const int table = call.index(1);
  if (!lua_istable(L, table)) call.refuse(1, "a table of flags");
  std::map<std::string, std::string> flags;
  lua_pushnil(L);
  while (lua_next(L, table) != 0) {
    if (lua_type(L, -2) != LUA_TSTRING || lua_type(L, -1) != LUA_TSTRING)
      call.refuse(1, "a table of flags by the names of options, both text");
    flags.emplace(lua_tostring(L, -2), lua_tostring(L, -1));
    lua_pop(L, 1);
  }
  // Stages of the work that begin messages as functions do.
  std::set<std::string> functions{"calibration", "animation",        "merge",
                                  "groups",      "compact grouping", "metis grouping"};
  for (const FunctionEntry& entry : call.session().api().functions()) functions.insert(entry.name);
  call.session().console().flag_words().use(std::move(flags), std::move(functions));
  return 0;
}

int in_flags(Call& call) {
  return call.give(call.session().console().flag_words().in_flags(call.text(1)));
}

int inspect_value(Call& call) {
  return call.give(inspect(call.lua(), call.index(1)));
}

int quantity(Call& call) {
  const std::string wanted = call.text(2);
  if (const auto dimension = from_string<Dimension>(wanted))
    return call.give(quantity_at(call.lua(), call.index(1), *dimension, "quantity"));
  throw InputError(fmt::format("quantity: unknown dimension '{}'{}", wanted,
                               name_hint(wanted, words_of<Dimension>().names(), "dimensions are")));
}

void push_choices(lua_State* L) {
  begin_table(L);
  for (const auto& [name, words] : session_of(L).api().choices()) {
    push(L, words.names());
    for (const Words::Word& word : words.all) {
      begin_table(L);
      set_field(L, "help", word.help);
      for (const auto& [trait, holds] : word.traits) set_field(L, trait.c_str(), holds);
      end_field(L, word.name.c_str());
    }
    end_field(L, name.c_str());
  }
}

bool has_ending(const fs::path& path, const std::vector<std::string>& endings) {
  if (endings.empty()) return true;
  std::string ending = path.extension().string();
  std::transform(ending.begin(), ending.end(), ending.begin(),
                 [](unsigned char c) { return std::tolower(c); });
  return std::find(endings.begin(), endings.end(), ending) != endings.end();
}

int files(Call& call) {
  const fs::path folder = call.readable(1);
  std::vector<std::string> endings;
  TableReader options = call.options(2);
  options.read("endings", endings);
  options.finish();
  std::error_code error;
  if (!fs::is_directory(folder, error))
    throw IoError(fmt::format("{} is not a folder", folder.string()));
  std::vector<std::string> found;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder))
    if (entry.is_regular_file(error) && has_ending(entry.path(), endings))
      found.push_back(entry.path().string());
  std::sort(found.begin(), found.end());
  return call.give(found);
}

int is_folder(Call& call) {
  std::error_code error;
  return call.give(fs::is_directory(call.readable(1), error));
}

ordered_json to_json(lua_State* L, int index, int depth, std::size_t& values);

/// Throws InputError if the table has more than the entries 1 .. length.
void require_list(lua_State* L, int table, lua_Integer length) {
  lua_pushnil(L);
  while (lua_next(L, table) != 0) {
    lua_pop(L, 1);
    const bool entry =
        lua_isinteger(L, -1) != 0 && lua_tointeger(L, -1) >= 1 && lua_tointeger(L, -1) <= length;
    if (entry) continue;
    lua_pushvalue(L, -1);  // lua_tostring would change a number that lua_next needs
    throw InputError(fmt::format(
        "json: a table has the list entries 1 to {} and the key '{}'; JSON has either lists or "
        "keys, so write them as two tables",
        length, luaL_tolstring(L, -1, nullptr)));
  }
}

ordered_json table_to_json(lua_State* L, int table, int depth, std::size_t& values) {
  if (depth > kJsonDepth) throw InputError("json: the tables are nested too deeply");
  luaL_checkstack(L, 8, "json");
  const auto length = static_cast<lua_Integer>(lua_rawlen(L, table));
  if (length > 0) {
    require_list(L, table, length);
    ordered_json list = ordered_json::array();
    for (lua_Integer i = 1; i <= length; ++i) {
      lua_rawgeti(L, table, i);
      list.push_back(to_json(L, lua_gettop(L), depth + 1, values));
      lua_pop(L, 1);
    }
    return list;
  }
  std::vector<std::pair<std::string, ordered_json>> members;
  lua_pushnil(L);
  while (lua_next(L, table) != 0) {
    if (lua_type(L, -2) != LUA_TSTRING)
      throw InputError(fmt::format("json: a table has a key that is {}; keys are words, or 1..n",
                                   describe_type_at(L, -2)));
    members.emplace_back(lua_tostring(L, -2), to_json(L, lua_gettop(L), depth + 1, values));
    lua_pop(L, 1);
  }
  std::sort(members.begin(), members.end(),
            [](const auto& a, const auto& b) { return a.first < b.first; });
  ordered_json object = members.empty() ? ordered_json::array() : ordered_json::object();
  for (auto& [key, value] : members) object[key] = std::move(value);
  return object;
}

ordered_json to_json(lua_State* L, int index, int depth, std::size_t& values) {
  if (++values > kJsonValues)
    throw InputError(fmt::format(
        "json: more than {} values; is a table contained in several others?", kJsonValues));
  switch (lua_type(L, index)) {
    case LUA_TNIL:
      return nullptr;
    case LUA_TBOOLEAN:
      return lua_toboolean(L, index) != 0;
    case LUA_TNUMBER:
      if (lua_isinteger(L, index) != 0) return lua_tointeger(L, index);
      if (!std::isfinite(lua_tonumber(L, index))) return nullptr;  // JSON has no infinity
      return lua_tonumber(L, index);
    case LUA_TSTRING: {
      std::size_t length = 0;
      const char* text = lua_tolstring(L, index, &length);
      return std::string(text, length);
    }
    case LUA_TTABLE:
      return table_to_json(L, index, depth, values);
    default:
      throw InputError(
          fmt::format("json: cannot write {}; pass plain tables", describe_type_at(L, index)));
  }
}

int json(Call& call) {
  int indent = 2;
  TableReader options = call.options(2);
  options.read("indent", indent);
  options.finish();
  lua_settop(call.lua(), call.index(1));
  std::size_t values = 0;
  const ordered_json value = to_json(call.lua(), call.index(1), 0, values);
  return call.give(value.dump(indent, ' ', false, ordered_json::error_handler_t::replace));
}

void describe_constants(Api& api) {
  api.add(ConstantEntry{{.name = "version", .type = "string", .help = "version of springlod"},
                        [](lua_State* L) { push(L, version()); }});
  api.add(ConstantEntry{
      {.name = "seed", .type = "integer", .help = "--seed of the command line, else 1"},
      [](lua_State* L) { push(L, session_of(L).settings().seed); }});
  api.add(ConstantEntry{
      {.name = "threads", .type = "integer", .help = "--threads of the command line; 0: all cores"},
      [](lua_State* L) { push(L, session_of(L).settings().threads); }});
  api.add(
      ConstantEntry{{.name = "portable",
                     .type = "boolean",
                     .help = "whether results have the same bits on every processor: --portable "
                             "of the command line"},
                    [](lua_State* L) { push(L, session_of(L).settings().portable); }});
  api.add(ConstantEntry{
      {.name = "choices",
       .type = "table",
       .help = "words that options take and fields have: s.choices.border lists those of border, "
               "s.choices.border.weak.help describes one"},
      push_choices});
  api.add(ConstantEntry{{.name = "samples",
                         .type = "string",
                         .help = "folder of the sample meshes, materials and scenes"},
                        [](lua_State* L) { push(L, sample_folder().string()); }});
  api.add(ConstantEntry{{.name = "docs",
                         .type = "string",
                         .help = "folder of the documentation, Markdown files; the files may be "
                                 "missing"},
                        [](lua_State* L) { push(L, doc_folder().string()); }});
  api.add(ConstantEntry{
      {.name = "verbosity", .type = "integer", .help = "-1 under -q, 1 under -v, else 0"},
      [](lua_State* L) { push(L, static_cast<int>(session_of(L).settings().verbosity) - 1); }});
}

}  // namespace

void describe_session(Api& api) {
  api.add(FunctionEntry{
      .name = "help",
      .group = kGroup,
      .summary =
          "Prints help on a function, a value type, a table or a constant; help() lists all. Also "
          "available as the global help.",
      .arguments = {{.name = "topic",
                     .type = "function, value or string",
                     .fallback = "an overview",
                     .help = "topic to explain: s.simplify, a value, \"Mesh\", \"Model:node\""}},
      .returns = "nothing",
      .errors = "There is no help on that name; the message has the nearest one.",
      .example = "help(s.simplify)",
      .call = help});
  api.add(FunctionEntry{
      .name = "say",
      .group = kGroup,
      .summary = "Writes a message line to stderr; silent with -q. Use print for results.",
      .arguments = {{.name = "text", .type = "string", .help = "text of the line"}},
      .returns = "nothing",
      .errors = "The argument is not text.",
      .example = "s.say(\"half way\")",
      .call = say});
  api.add(FunctionEntry{
      .name = "use_flags",
      .group = kGroup,
      .summary = "Lets the messages of springlod name options by the flags of a command, as in "
                 "--hinges fill for hinges = \"fill\".",
      .arguments = {{.name = "flags",
                     .type = "table of strings",
                     .help = "the flag of each option, by the option's name; --no-... if it sets "
                             "the option to false"}},
      .returns = "nothing",
      .errors = "Not a table of texts.",
      .example = "s.use_flags{hinges = \"--hinges\", guards = \"--no-guards\"}",
      .call = use_flags});
  api.add(FunctionEntry{.name = "in_flags",
                        .group = kGroup,
                        .summary = "Returns a text with its options named by the flags of "
                                   "use_flags.",
                        .arguments = {{.name = "text", .type = "string", .help = "any text"}},
                        .returns = "string",
                        .errors = "The argument is not text.",
                        .example = "print(s.in_flags(\"use hinges = \\\"fill\\\"\"))",
                        .call = in_flags});
  api.add(FunctionEntry{.name = "inspect",
                        .group = kGroup,
                        .summary = "Formats any Lua value as text, with the keys of tables sorted.",
                        .arguments = {{.name = "value", .type = "any", .help = "value to show"}},
                        .returns = "string",
                        .errors = "None.",
                        .example = "print(s.inspect(s.info(chain)))",
                        .call = inspect_value});
  api.add(FunctionEntry{
      .name = "json",
      .group = kGroup,
      .summary = "Formats tables, numbers, text and booleans as JSON with sorted keys.",
      .arguments = {{.name = "value",
                     .type = "any",
                     .help = "plain Lua data; an empty table is []"}},
      .options = {{.name = "indent",
                   .type = "integer",
                   .range = Range{-1, 16},
                   .fallback = "2",
                   .help = "spaces per level of nesting; -1: all on one line"}},
      .returns = "string",
      .errors = "A function or a springlod value, which has no JSON form; read its fields first.",
      .example = "print(s.json(s.info(chain)))",
      .call = json});
  api.add(
      FunctionEntry{.name = "quantity",
                    .group = kGroup,
                    .summary = "Reads text with a unit, such as \"5 mm\", as a number in SI units.",
                    .arguments = {{.name = "text",
                                   .type = "string or number",
                                   .help = "text with a unit; a number is in SI units"},
                                  {.name = "dimension",
                                   .type = "one of",
                                   .help = "physical dimension",
                                   .choices = words_of<Dimension>()}},
                    .returns = "number",
                    .errors = "A unit of another dimension; the message lists the right ones.",
                    .example = "local cell = s.quantity(\"5 mm\", \"length\")",
                    .call = quantity});
  api.add(FunctionEntry{
      .name = "files",
      .group = kGroup,
      .summary = "Lists the files of a folder, sorted.",
      .arguments = {{.name = "folder", .type = "string", .help = "path of the folder"}},
      .options = {{.name = "endings",
                   .type = "list of strings",
                   .fallback = "all files",
                   .help = "endings in lower case with the dot: {\".obj\", \".stl\"}"}},
      .returns = "list of strings: paths",
      .errors = "Not a folder.",
      .example =
          "for _, path in ipairs(s.files(\"meshes\", {endings = {\".obj\"}})) do print(path) end",
      .call = files});
  api.add(FunctionEntry{.name = "is_folder",
                        .group = kGroup,
                        .summary = "Returns whether a path is a folder.",
                        .arguments = {{.name = "path", .type = "string", .help = "any path"}},
                        .returns = "boolean",
                        .errors = "The argument is not text.",
                        .example = "if s.is_folder(path) then print(\"a folder\") end",
                        .call = is_folder});
  api.add(FunctionEntry{.name = "api_markdown",
                        .group = kGroup,
                        .summary = "Returns this documentation as Markdown, as in docs/api.md.",
                        .returns = "string",
                        .errors = "None.",
                        .example = "print(require(\"springlod\").api_markdown())",
                        .call = markdown});
  describe_constants(api);
}

}  // namespace springlod::scripting
