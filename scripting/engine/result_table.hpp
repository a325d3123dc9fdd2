#pragma once

#include <cstddef>

#include "scripting/engine/api.hpp"
#include "scripting/engine/value.hpp"

struct lua_State;

namespace springlod::scripting {

/// Pushes a list with a table for each entry; fill(entry) sets the fields of the table on top.
template <class Entries, class Fill>
void push_tables(lua_State* L, const Entries& entries, const Fill& fill) {
  begin_list(L, entries.size());
  std::size_t number = 0;
  for (const auto& entry : entries) {
    begin_table(L);
    fill(entry);
    end_list_entry(L, ++number);
  }
}

/// Describes a field of a record that a function returns.
inline Parameter result_field(const char* name, const char* type, const char* help) {
  return {.name = name, .type = type, .help = help};
}

}  // namespace springlod::scripting
