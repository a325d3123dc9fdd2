// The options of functions, for scripts that offer them to their own users.

#include <lua.hpp>

#include "base/error.hpp"
#include "scripting/bind/topics.hpp"
#include "scripting/engine/call.hpp"
#include "scripting/engine/result_table.hpp"

namespace springlod::scripting {

namespace {

const std::vector<Parameter>& parameters_named(const Api& api, const std::string& name) {
  if (const FunctionEntry* function = api.find_function(name)) return function->options;
  for (const RecordEntry& record : api.records())
    if (record.name == name) return record.fields;
  throw InputError("options_of: there is no function or record \"" + name +
                   "\"; help() lists them");
}

int options_of_binding(Call& call) {
  lua_State* L = call.lua();
  push_tables(L, parameters_named(call.session().api(), call.text(1)), [L](const Parameter& p) {
    set_field(L, "name", p.name);
    set_field(L, "type", p.type);
    set_field(L, "default", p.fallback);
    set_field(L, "help", p.help);
    if (p.range) {
      set_field(L, "least", p.range->least);
      set_field(L, "most", p.range->most);
    }
    set_field(L, "choices", p.choices.names());
  });
  return 1;
}

}  // namespace

void describe_options_of(Api& api) {
  api.add(FunctionEntry{
      .name = "options_of",
      .group = "Session",
      .summary = "Lists the options of a function, or the keys of a table that it takes, as help "
                 "shows them: for scripts that offer them as options of their own.",
      .arguments = {{.name = "name",
                     .type = "string",
                     .help = "function of springlod or name of a table: \"simplify\", "
                             "\"Calibration\""}},
      .returns =
          "list of tables: name, type, default (text, \"\" if required), help, least and most "
          "(ends "
          "of its range in SI units; nil if none is stated), choices (list of words; empty if any "
          "value is allowed)",
      .errors = "There is no function or table of that name.",
      .example = "for _, option in ipairs(s.options_of(\"simplify\")) do print(option.name) end",
      .call = options_of_binding});
}

}  // namespace springlod::scripting
