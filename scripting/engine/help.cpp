#include "scripting/engine/help.hpp"

#include <algorithm>
#include <utility>

#include <fmt/format.h>
#include <lua.hpp>

#include "base/error.hpp"
#include "scripting/engine/call.hpp"
#include "scripting/engine/paths.hpp"
#include "scripting/engine/suggest.hpp"

namespace springlod::scripting {

namespace {

/// "\"none\", \"weak\""
std::string quoted(const Words& words) {
  std::vector<std::string> all;
  for (const std::string& name : words.names()) all.push_back(fmt::format("\"{}\"", name));
  return fmt::format("{}", fmt::join(all, ", "));
}

// Wraps `text` to lines of at most `width`, indented but for `first`, the start of the first line.
std::string wrapped(const std::string& text, std::size_t indent, std::size_t width,
                    std::string first = "") {
  std::string result;
  std::string line = std::move(first);
  line.resize(std::max(indent, line.size()), ' ');
  std::size_t start = 0;
  while (start < text.size()) {
    std::size_t end = text.find(' ', start);
    if (end == std::string::npos) end = text.size();
    if (line.size() > indent && line.size() + 1 + end - start > width) {
      result += line + "\n";
      line.assign(indent, ' ');
    }
    if (line.size() > indent) line += ' ';
    line += text.substr(start, end - start);
    start = end + 1;
  }
  return result + line + "\n";
}

std::string indented(const std::string& text, std::size_t indent) {
  std::string result(indent, ' ');
  for (const char c : text) {
    result += c;
    if (c == '\n') result += std::string(indent, ' ');
  }
  return result + "\n";
}

std::string listing(const std::vector<Parameter>& parameters, std::size_t width) {
  std::size_t names = 0;
  for (const Parameter& parameter : parameters) names = std::max(names, parameter.name.size());
  std::string text;
  for (const Parameter& parameter : parameters) {
    text += wrapped(type_and_default(parameter), names + 4, width,
                    fmt::format("  {:<{}}  ", parameter.name, names));
    text += wrapped(parameter.help, names + 6, width);
    for (const Words::Word& word : parameter.choices.all)
      if (!word.help.empty())
        text += wrapped(fmt::format("\"{}\": {}", word.name, word.help), names + 8, width);
  }
  return text;
}

/// "1 ms to 10 s", "at most 1000 bytes".
std::string range_text(const Parameter& parameter) {
  if (parameter.type.find("string") != std::string::npos)
    return fmt::format("at most {} bytes", parameter.range->most);
  return to_string(*parameter.range, parameter.dimension);
}

std::vector<Parameter> fields_of(const TypeEntry& type) {
  std::vector<Parameter> fields;
  for (const FieldEntry& field : type.fields) fields.push_back(field.parameter);
  return fields;
}

std::vector<std::string> groups_of(const Api& api) {
  std::vector<std::string> groups;
  for (const FunctionEntry& entry : api.functions())
    if (std::find(groups.begin(), groups.end(), entry.group) == groups.end())
      groups.push_back(entry.group);
  return groups;
}

// Escapes "|", which would end the cell of a Markdown table.
std::string escaped(const std::string& text) {
  std::string result;
  for (const char c : text) result += c == '|' ? "\\|" : std::string(1, c);
  return result;
}

/// Table cell of a parameter: its help, then one line for each of its words.
std::string meaning(const Parameter& parameter) {
  std::string text = escaped(parameter.help);
  for (const Words::Word& word : parameter.choices.all)
    if (!word.help.empty()) text += fmt::format("<br>`\"{}\"`: {}", word.name, escaped(word.help));
  return text;
}

std::string markdown_rows(const std::vector<Parameter>& parameters) {
  std::string text = "| name | type | meaning |\n|---|---|---|\n";
  for (const Parameter& parameter : parameters)
    text += fmt::format("| `{}` | {} | {} |\n", parameter.name,
                        escaped(type_and_default(parameter)), meaning(parameter));
  return text + "\n";
}

std::string markdown(const FunctionEntry& entry, const std::string& heading) {
  std::string text =
      fmt::format("{} {}\n\n`{}`\n\n{}\n\n", heading, entry.name, signature(entry), entry.summary);
  if (!entry.arguments.empty()) text += "Arguments:\n\n" + markdown_rows(entry.arguments);
  if (!entry.options.empty()) text += "Options:\n\n" + markdown_rows(entry.options);
  text += fmt::format("Returns: {}\n\n", entry.returns);
  if (!entry.errors.empty()) text += fmt::format("Errors: {}\n\n", entry.errors);
  if (!entry.example.empty()) text += fmt::format("```lua\n{}\n```\n\n", entry.example);
  return text;
}

std::string markdown(const TypeEntry& type) {
  std::string text = fmt::format("### {}\n\n{}\n\n", type.name, type.summary);
  if (!type.fields.empty()) text += markdown_rows(fields_of(type));
  for (const FunctionEntry& method : type.methods) text += markdown(method, "####");
  return text;
}

// Whether the value at `index` is the table of a path from the module, such as {"choices", "unit"}.
bool is_table_of_module(lua_State* L, int index, const std::vector<std::string>& path) {
  const int value = lua_absindex(L, index);
  const int bottom = lua_gettop(L);
  luaL_getsubtable(L, LUA_REGISTRYINDEX, LUA_LOADED_TABLE);
  lua_pushliteral(L, "springlod");
  lua_rawget(L, -2);
  for (const std::string& name : path) {
    if (!lua_istable(L, -1)) break;
    push(L, name);
    lua_rawget(L, -2);
  }
  const bool same = lua_rawequal(L, value, -1) != 0;
  lua_settop(L, bottom);
  return same;
}

/// "  simplify      Builds a chain ..."
std::string overview_line(const std::string& name, const std::string& summary, std::size_t width) {
  constexpr std::size_t kNameColumn = 16;
  return wrapped(summary, kNameColumn, width, "  " + name + " ");
}

}  // namespace

std::string type_and_default(const Parameter& parameter) {
  std::string text = parameter.type;
  if (!parameter.choices.empty()) text += fmt::format(" {}", quoted(parameter.choices));
  const std::string_view unit = si_unit(parameter.dimension);
  if (parameter.dimension != Dimension::number) text += fmt::format(" in {}", unit);
  if (parameter.range) text += ", " + range_text(parameter);
  if (!parameter.fallback.empty()) text += fmt::format("; default {}", parameter.fallback);
  return text;
}

std::string signature(const FunctionEntry& entry) {
  std::string text = entry.owner.empty() ? "s." : entry.owner + ":";
  if (!entry.owner.empty()) std::transform(text.begin(), text.end(), text.begin(), ::tolower);
  std::vector<std::string> taken;
  for (const Parameter& argument : entry.arguments)
    taken.push_back(argument.fallback.empty() ? argument.name : "[" + argument.name + "]");
  if (!entry.options.empty()) {
    std::vector<std::string> names;
    for (const Parameter& option : entry.options) names.push_back(option.name);
    // The full list follows below; a signature should fit on one line.
    constexpr std::size_t kShown = 4;
    if (names.size() > kShown) {
      names.resize(kShown);
      names.emplace_back("...");
    }
    taken.push_back("{" + comma_list(names) + "}");
  }
  return fmt::format("{}{}({}) -> {}", text, entry.name, comma_list(taken),
                     entry.returns.substr(0, entry.returns.find(':')));
}

std::string overview(const Api& api, std::size_t width) {
  std::string text = fmt::format("springlod {}: local s = require \"springlod\"\n", version());
  for (const std::string& group : groups_of(api)) {
    text += fmt::format("\n{}\n", group);
    for (const FunctionEntry& entry : api.functions())
      if (entry.group == group) text += overview_line(entry.name, entry.summary, width);
  }
  text += "\nValues\n";
  for (const TypeEntry& type : api.types()) text += overview_line(type.name, type.summary, width);
  text += "\nTables with known keys\n";
  for (const RecordEntry& record : api.records())
    text += overview_line(record.name, record.summary, width);
  text += "\nConstants\n";
  for (const ConstantEntry& constant : api.constants())
    text += overview_line(constant.parameter.name, constant.parameter.help, width);
  return text + "\nhelp(s.simplify), help(\"Mesh\"), help(value) print details.";
}

std::string help_for(const FunctionEntry& entry, std::size_t width) {
  std::string text = signature(entry) + "\n\n" + wrapped(entry.summary, 0, width);
  if (!entry.arguments.empty()) text += "\nArguments\n" + listing(entry.arguments, width);
  if (!entry.options.empty()) text += "\nOptions\n" + listing(entry.options, width);
  text += "\n" + wrapped(entry.returns, 2, width, "Returns");
  if (!entry.errors.empty()) text += "\nErrors\n" + wrapped(entry.errors, 2, width);
  if (!entry.example.empty()) text += "\nExample\n" + indented(entry.example, 2);
  text.pop_back();
  return text;
}

std::string help_for(const TypeEntry& type, std::size_t width) {
  std::string text = type.name + "\n\n" + wrapped(type.summary, 0, width);
  if (!type.fields.empty()) text += "\nFields\n" + listing(fields_of(type), width);
  if (!type.methods.empty()) text += "\nMethods\n";
  for (const FunctionEntry& method : type.methods)
    text += fmt::format("  {}\n", signature(method)) + wrapped(method.summary, 6, width);
  text.pop_back();
  return text;
}

std::string help_for(const Words& words, std::size_t width) {
  std::string text = fmt::format("s.choices.{}\n\n", words.name);
  for (const Words::Word& word : words.all)
    text += word.help.empty() ? fmt::format("  \"{}\"\n", word.name)
                              : wrapped(fmt::format("\"{}\": {}", word.name, word.help), 2, width);
  text.pop_back();
  return text;
}

std::string help_for(const RecordEntry& record, std::size_t width) {
  std::string text = record.name + "\n\n" + wrapped(record.summary, 0, width) + "\nKeys\n" +
                     listing(record.fields, width);
  if (!record.example.empty()) text += "\nExample\n" + indented(record.example, 2);
  text.pop_back();
  return text;
}

std::string help_for(const ConstantEntry& constant, std::size_t width) {
  std::string text = fmt::format("s.{}: {}\n\n", constant.parameter.name, constant.parameter.type) +
                     wrapped(constant.parameter.help, 2, width);
  text.pop_back();
  return text;
}

std::string help_for(const Api& api, const std::string& name, std::size_t width) {
  if (name.starts_with("s.")) return help_for(api, name.substr(2), width);
  if (const FunctionEntry* entry = api.find_function(name)) return help_for(*entry, width);
  if (const TypeEntry* type = api.find_type(name)) return help_for(*type, width);
  for (const RecordEntry& record : api.records())
    if (record.name == name) return help_for(record, width);
  for (const TypeEntry& type : api.types())
    for (const FunctionEntry& method : type.methods)
      if (name == type.name + ":" + method.name || name == type.name + "." + method.name)
        return help_for(method, width);
  for (const ConstantEntry& constant : api.constants())
    if (name == constant.parameter.name) return help_for(constant, width);
  for (const auto& [table, words] : api.choices())
    if (name == table || name == "choices." + table) return help_for(words, width);
  for (const StockCommand& command : stock_commands())
    if (name == command.name)
      throw InputError(fmt::format(
          "{0} is a command for the shell; there, springlod help {0} explains it", name));
  throw InputError(fmt::format("no help on '{}'{} (help() lists all names)", name,
                               did_you_mean(name, help_topics(api))));
}

std::string help_at(lua_State* L, int index, const Api& api, std::size_t width) {
  if (lua_type(L, index) == LUA_TSTRING) return help_for(api, lua_tostring(L, index), width);
  if (const FunctionEntry* entry = entry_of_function(L, index)) return help_for(*entry, width);
  for (const TypeEntry& type : api.types())
    if (boxed_at(L, index, type.tag)) return help_for(type, width);
  if (lua_istable(L, index)) {
    for (const ConstantEntry& constant : api.constants())
      if (is_table_of_module(L, index, {constant.parameter.name})) return help_for(constant, width);
    for (const auto& [name, words] : api.choices())
      if (is_table_of_module(L, index, {"choices", name})) return help_for(words, width);
  }
  throw InputError(
      fmt::format("there is no help on {}; pass a function (help(s.simplify)), a value, or a name "
                  "(help(\"Mesh\"))",
                  describe_type_at(L, index)));
}

std::vector<std::string> help_topics(const Api& api) {
  std::vector<std::string> names;
  for (const FunctionEntry& entry : api.functions()) names.push_back(entry.name);
  for (const TypeEntry& type : api.types()) names.push_back(type.name);
  for (const RecordEntry& record : api.records()) names.push_back(record.name);
  for (const TypeEntry& type : api.types())
    for (const FunctionEntry& method : type.methods) names.push_back(type.name + ":" + method.name);
  for (const ConstantEntry& constant : api.constants()) names.push_back(constant.parameter.name);
  for (const auto& [table, words] : api.choices()) names.push_back("choices." + table);
  return names;
}

std::string api_markdown(const Api& api) {
  std::string text =
      "# The scripting API\n\n"
      "Written by springlod itself: `springlod -e 'print(require(\"springlod\").api_markdown())'`. "
      "Do not edit.\n\n"
      "A *quantity* is a number in the SI unit named, or text with a unit: `0.005` or `\"5 mm\"`. "
      "Nodes and springs are counted from 1, levels from 0 (the base). Options come in a table "
      "after the other arguments. Ranges include both ends. ";
  text += fmt::format(
      "Options without a stated range take numbers of {}, text of at most {} bytes and lists of "
      "at most {} entries; seeds are any whole numbers from 0.\n\n",
      to_string(kUsualNumbers, Dimension::number), kUsualText.most, kLongestList);
  for (const std::string& group : groups_of(api)) {
    text += fmt::format("## {}\n\n", group);
    for (const FunctionEntry& entry : api.functions())
      if (entry.group == group) text += markdown(entry, "###");
  }
  text += "## Tables with known keys\n\n";
  for (const RecordEntry& record : api.records()) {
    text += fmt::format("### {}\n\n{}\n\n{}", record.name, record.summary,
                        markdown_rows(record.fields));
    if (!record.example.empty()) text += fmt::format("```lua\n{}\n```\n\n", record.example);
  }
  text += "## Values\n\n";
  for (const TypeEntry& type : api.types()) text += markdown(type);
  text +=
      "## Choices\n\nThe words of `s.choices`, which the options above take and some fields "
      "have.\n\n| table | words "
      "|\n|---|---|\n";
  for (const auto& [name, words] : api.choices())
    text += fmt::format("| `s.choices.{}` | {} |\n", name, quoted(words));
  text += "\n## Constants\n\n";
  std::vector<Parameter> constants;
  for (const ConstantEntry& constant : api.constants()) constants.push_back(constant.parameter);
  text += markdown_rows(constants);
  text.pop_back();
  return text;
}

}  // namespace springlod::scripting
