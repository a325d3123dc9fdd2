#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "scripting/engine/state.hpp"

namespace springlod::scripting {

/// Runs the interactive prompt with history, completion and multi-line input; it prints the values
/// of expressions. Ctrl-C cancels the line or the running computation. Ctrl-D ends the prompt, and
/// the function returns. If stdin is not a terminal, lines are read without editing.
void run_prompt(ScriptState& state);

/// Result of evaluating one input.
struct Reply {
  bool incomplete = false;  ///< more lines are needed
  std::string error;        ///< message with traceback; empty on success
};
/// Evaluates a chunk as the prompt does; prints the values of an expression to stdout.
Reply evaluate(ScriptState& state, const std::string& input);

/// Completions of the last name or path before the cursor (`s.vox` -> `voxelize`) from globals,
/// fields, methods and keywords.
std::vector<std::string> completions(ScriptState& state, std::string_view before_cursor);

}  // namespace springlod::scripting
