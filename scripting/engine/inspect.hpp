#pragma once

#include <string>

struct lua_State;

namespace springlod::scripting {

struct InspectOptions {
  int depth = 4;        ///< tables within tables shown
  int entries = 40;     ///< of one table
  int line_width = 88;  ///< a table that fits is written on one line
};

/// The Lua value at `index` as a person wants to see it at the prompt: tables with sorted keys,
/// nested, cut off where they get long; values by their own tostring.
std::string inspect(lua_State* L, int index, const InspectOptions& options = {});

}  // namespace springlod::scripting
