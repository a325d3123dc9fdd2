#pragma once

#include <vector>

#include "lod/build.hpp"
#include "scripting/engine/call.hpp"

namespace springlod::scripting {

/// Reads how a script wants nodes grouped (the options grouping, node_priority and pair_cost of
/// `simplify`) into `options`. Lua functions become callbacks that call back into `L`, so the
/// options are good for the duration of the call only.
void read_grouping(TableReader& reader, lod::SimplifyOptions& options);

/// Says of the option `grouping` what it takes besides words.
void extend_grouping_parameter(Parameter& grouping);
/// The options node_priority and pair_cost.
std::vector<Parameter> grouping_function_parameters();

}  // namespace springlod::scripting
