#pragma once

#include <vector>

#include "lod/build.hpp"
#include "scripting/engine/call.hpp"

namespace springlod::scripting {

/// Reads the options grouping, node_priority and pair_cost of `simplify` into `options`. Callbacks
/// in `options` call Lua functions in `L`, so `options` is valid only during the call.
void read_grouping(TableReader& reader, lod::SimplifyOptions& options);

/// Describes the values of the option `grouping` that are not words.
void extend_grouping_parameter(Parameter& grouping);
/// The options node_priority and pair_cost.
std::vector<Parameter> grouping_function_parameters();

}  // namespace springlod::scripting
