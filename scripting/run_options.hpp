#pragma once

#include <vector>

#include "scripting/api.hpp"
#include "scripting/call.hpp"
#include "sim/run.hpp"

namespace springlod {

/// The options of every function that runs models; `usual` is what it does without them.
std::vector<Parameter> run_parameters(const RunOptions& usual);
void read_run_options(Call& call, TableReader& reader, RunOptions& options);

}  // namespace springlod
