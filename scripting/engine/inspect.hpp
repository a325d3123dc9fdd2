#pragma once

#include <string>

struct lua_State;

namespace springlod::scripting {

struct InspectOptions {
  int depth = 4;        ///< maximum nesting depth shown
  int entries = 40;     ///< maximum entries shown of each table
  int line_width = 88;  ///< a table that fits is written on one line
};

/// Readable text of the Lua value at `index`: nested tables with sorted keys, truncated at the
/// limits of `options`; other values by tostring.
std::string inspect(lua_State* L, int index, const InspectOptions& options = {});

/// Lets tostring and print show the table on top of the stack as inspect does.
void print_inspected(lua_State* L);

}  // namespace springlod::scripting
