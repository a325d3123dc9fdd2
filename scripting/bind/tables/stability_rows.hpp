#pragma once

#include "scripting/engine/call.hpp"
#include "sim/study/stability_map.hpp"

// Stability maps as lists of tables that hold all of them, so that parts of a map that were
// computed apart can be joined.

namespace springlod::scripting {

/// The record StabilityRow.
RecordEntry stability_row_entry();

/// Pushes a list with a StabilityRow for each point.
void push_stability_rows(lua_State* L, const sim::StabilityMap& map);

/// The map of the list of StabilityRows at an argument. Rows of the same level and ratio belong to
/// the same body. Throws InputError for rows that are none.
sim::StabilityMap read_stability_rows(Call& call, int argument);

}  // namespace springlod::scripting
